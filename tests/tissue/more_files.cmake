# Surface files and DICOM files: properties, oracles and refusals beyond those of surfaces/ and dicom/.
trocar_test(files_more_test
  SOURCES
    files_more/contours_more_test.cpp
    files_more/surface_pieces_more_test.cpp
  LINK trocar_tissue ZLIB::ZLIB)
