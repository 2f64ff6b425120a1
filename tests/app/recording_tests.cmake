# Recording: codec, container, crash behaviour; and its benchmark.
trocar_test(test_recording
  SOURCES recording_codec_test.cpp recording_container_test.cpp recording_damage_test.cpp recording_disk_test.cpp recording_schedule_test.cpp recording_sink_test.cpp recording_stiffness_test.cpp
          recording_samples.cpp
  LINK trocar_recorder trocar_digest)

find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_executable(bench_recording ${PROJECT_SOURCE_DIR}/tests/bench/recording_bench.cpp recording_samples.cpp)
  target_link_libraries(bench_recording PRIVATE trocar_options trocar_recorder benchmark::benchmark)
endif()

# The commands that read the store.
find_package(SQLite3 REQUIRED)
find_package(nlohmann_json REQUIRED)
trocar_test(test_store_commands
  SOURCES recording_store_commands_test.cpp trainee_rights_test.cpp ${PROJECT_SOURCE_DIR}/tests/trainees/store_samples.cpp
  LINK trocar_commands nlohmann_json::nlohmann_json SQLite::SQLite3)
trocar_test(test_export_command
  SOURCES export_command_test.cpp recording_samples.cpp ${PROJECT_SOURCE_DIR}/tests/trainees/export/export_samples.cpp
          ${PROJECT_SOURCE_DIR}/tests/trainees/store_samples.cpp
  LINK trocar_commands trocar_digest nlohmann_json::nlohmann_json SQLite::SQLite3)
