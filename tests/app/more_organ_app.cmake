trocar_test(organ_app_more_test
  SOURCES
    organ_more/import_source_more_test.cpp
    organ_more/board_spacing_more_test.cpp
    organ_more/organ_files_more_test.cpp
    organ_more/neighbours_more_test.cpp
    organ_more/volumes_and_labels_more_test.cpp
    organ_more/organ_words_more_test.cpp
  LINK trocar_commands nlohmann_json::nlohmann_json PkgConfig::ZIP)
