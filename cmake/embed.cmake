# cmake -DOUT=FILE.cpp -DHEADER=HEADER -DNAMESPACE=NAME "-DFUNCTIONS=function=file;..." -P embed.cmake
# Writes a source with one function a file, which returns the file's text.
set(_source "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n")
foreach(_pair IN LISTS FUNCTIONS)
  string(REGEX MATCH "^([a-z_]+)=(.+)$" _whole "${_pair}")
  set(_function "${CMAKE_MATCH_1}")
  file(READ "${CMAKE_MATCH_2}" _text)
  string(APPEND _source "\nconst char* ${_function}() {\n  return R\"asset(${_text})asset\";\n}\n")
endforeach()
file(WRITE "${OUT}" "${_source}\n}  // namespace ${NAMESPACE}\n")
