# One ctest test a GoogleTest suite: cases of a suite share a process, so that its start and what SetUpTestSuite makes is paid once.
# Each test has a cache folder of its own; compiled shaders they share, for compiling them anew takes a second or two.
# Included by tests/CMakeLists.txt; run by itself (cmake -P) after each link it lists the suites of PROGRAM into FILE.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE _listed COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "," _listed "${_listed}")
  string(REPLACE "\n" ";" _listed "${_listed}")
  set(_text "")
  set(_serial "")
  if("${LABELS}" MATCHES "serial")
    set(_serial " RUN_SERIAL TRUE")
  endif()
  # A suite counts as skipped when none passed and the last line names a skipped case: failed ones would be listed behind.
  foreach(_line IN LISTS _listed)
    if(_line MATCHES "^([A-Za-z0-9_/]+)\\.( |$)")
      set(_suite ${CMAKE_MATCH_1})
      string(APPEND _text "add_test([=[${NAME}.${_suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${_suite}.*]=])\n"
        "set_tests_properties([=[${NAME}.${_suite}]=] PROPERTIES TIMEOUT ${TIMEOUT} LABELS \"${LABELS}\"${_serial}"
        " ENVIRONMENT [=[MESA_SHADER_CACHE_DIR=${SHADERS}]=]"
        " SKIP_REGULAR_EXPRESSION [=[\\[  PASSED  \\] 0 tests.*\\[  SKIPPED \\] [A-Za-z0-9_/.]+[^A-Za-z]*$]=])\n")
    endif()
  endforeach()
  if(_text STREQUAL "")
    message(FATAL_ERROR "${PROGRAM}: no test suite")
  endif()
  file(WRITE ${FILE} "${_text}")
  return()
endif()

set(_suites_script ${CMAKE_CURRENT_LIST_FILE})
function(trocar_discover_suites name timeout labels)
  set(_file ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D NAME=${name} -D PROGRAM=$<TARGET_FILE:${name}> -D FILE=${_file} -D TIMEOUT=${timeout} -D LABELS=${labels}
            -D SHADERS=${CMAKE_CURRENT_BINARY_DIR}/shader_cache -P ${_suites_script}
    BYPRODUCTS ${_file} VERBATIM)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake
    "if(EXISTS \"${_file}\")\n  include(\"${_file}\")\nelse()\n  add_test(${name}_not_built ${name}_not_built)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
endfunction()
