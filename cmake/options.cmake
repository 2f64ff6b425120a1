# trocar_options: compile flags of every target of the project.
add_library(trocar_options INTERFACE)
target_include_directories(trocar_options INTERFACE ${PROJECT_SOURCE_DIR})
# Same input, same bytes: no fused multiply-add behind our back.
target_compile_options(trocar_options INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -pthread                 # everywhere, as some libraries ask for: headers read once fit sources with the same macros alone
                       -Wno-subobject-linkage)  # joined translation units: a type of one .cpp looks as if it came from a header
if(TROCAR_WERROR)
  target_compile_options(trocar_options INTERFACE -Werror)
endif()
if(TROCAR_SANITIZE)
  string(REPLACE ";" "," _sanitizers "${TROCAR_SANITIZE}")
  # False warnings of GCC about instrumented code: values that the plain build knows to be set, an operator delete that
  # frees what the operator new beside it has taken from malloc.
  target_compile_options(trocar_options INTERFACE -fsanitize=${_sanitizers} -fno-omit-frame-pointer -fno-sanitize-recover=all
                         -Wno-maybe-uninitialized -Wno-mismatched-new-delete)
  target_link_options(trocar_options INTERFACE -fsanitize=${_sanitizers})
endif()

# Heavy third-party template code (CGAL, ITK) under UBSan costs minutes a source: the cheap checks stay.
function(trocar_relax_sanitizer target)
  if(TROCAR_SANITIZE MATCHES "undefined")
    target_compile_options(${target} PRIVATE -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow)
  endif()
endfunction()

# Every .cpp of the named folders (not below them), so that a new file needs no line here.
function(trocar_sources result)
  set(_found)
  foreach(_room IN LISTS ARGN)
    file(GLOB _files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${_room}/*.cpp)
    if(NOT _files)
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}/${_room}: no source in this folder")
    endif()
    list(APPEND _found ${_files})
  endforeach()
  set(${result} ${_found} PARENT_SCOPE)
endfunction()

# trocar_headers(NAME headers...): what nearly every source includes is parsed once; trocar_read_once(TARGET NAME) then takes it from there. Joined builds
# alone: cmake/alone compiles each source as it stands.
function(trocar_headers name)
  if(CMAKE_UNITY_BUILD)
    file(CONFIGURE OUTPUT ${name}.cpp CONTENT "")
    add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE trocar_options Eigen3::Eigen)
    target_precompile_headers(${name} PRIVATE ${ARGN})
  endif()
endfunction()
function(trocar_read_once target name)
  if(CMAKE_UNITY_BUILD)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# trocar_library(NAME ROOMS folders... [EXCEPT files...] [PUBLIC libs...] [PRIVATE libs...])
# A static library of all sources of its rooms. What it is compiled with besides: trocar_options.
function(trocar_library name)
  cmake_parse_arguments(ARG "" "" "ROOMS;EXCEPT;PUBLIC;PRIVATE" ${ARGN})
  trocar_sources(_sources ${ARG_ROOMS})
  foreach(_file IN LISTS ARG_EXCEPT)
    list(REMOVE_ITEM _sources ${CMAKE_CURRENT_SOURCE_DIR}/${_file})
  endforeach()
  add_library(${name} STATIC ${_sources})
  target_link_libraries(${name} PUBLIC trocar_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  trocar_read_once(${name} trocar_program_headers)
endfunction()
