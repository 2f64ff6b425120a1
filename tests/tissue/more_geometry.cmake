trocar_test(geometry_more_test SOURCES
  geometry_more/surface_facts_test.cpp
  geometry_more/label_complex_test.cpp
  geometry_more/field_surface_test.cpp
  geometry_more/lattice_promises_test.cpp
  LINK trocar_tissue)
