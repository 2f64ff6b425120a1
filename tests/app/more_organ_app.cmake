find_package(ZLIB REQUIRED)
trocar_test(organ_app_more_test
  SOURCES
    organ_more/import_source_more_test.cpp
    organ_more/board_spacing_more_test.cpp
    organ_more/organ_files_more_test.cpp
    organ_more/neighbours_more_test.cpp
    organ_more/volumes_and_labels_more_test.cpp
    organ_more/organ_words_more_test.cpp
    organ_more/organ_again_test.cpp
    organ_more/organ_grids_test.cpp
    organ_more/replaced_files_test.cpp
    ${PROJECT_SOURCE_DIR}/tests/tissue/dicom/dicom_fixture.cpp
    ${PROJECT_SOURCE_DIR}/tests/tissue/dicom/segmentation_fixture.cpp
  LINK trocar_commands nlohmann_json::nlohmann_json PkgConfig::ZIP ZLIB::ZLIB)
