# More of the imaging parts: shapes and structures of the phantom, axis orders, label tables, grids and streams.
find_package(ZLIB REQUIRED)
trocar_test(imaging_more_test
  SOURCES imaging_more/axis_order_test.cpp
          imaging_more/grid_segmentation_more_test.cpp
          imaging_more/label_tables_more_test.cpp
          imaging_more/phantom_structures_test.cpp
          imaging_more/shape_laws_test.cpp
          imaging_more/streams_more_test.cpp
  LINK trocar_tissue ZLIB::ZLIB)
