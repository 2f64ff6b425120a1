# Surface files and DICOM files: properties, oracles and refusals beyond those of surfaces/ and dicom/.
trocar_test(files_more_test
  SOURCES
    dicom/dicom_fixture.cpp
    files_more/contours_more_test.cpp
    files_more/slices_more_test.cpp
    files_more/surface_files_more_test.cpp
    files_more/surface_pieces_more_test.cpp
  LINK trocar_tissue ZLIB::ZLIB)
