# trocar_options: compile flags of every target of the project.
add_library(trocar_options INTERFACE)
target_include_directories(trocar_options INTERFACE ${PROJECT_SOURCE_DIR})
# Same input, same bytes: no fused multiply-add behind our back.
target_compile_options(trocar_options INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(TROCAR_WERROR)
  target_compile_options(trocar_options INTERFACE -Werror)
endif()
if(TROCAR_SANITIZE)
  string(REPLACE ";" "," _sanitizers "${TROCAR_SANITIZE}")
  target_compile_options(trocar_options INTERFACE -fsanitize=${_sanitizers} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(trocar_options INTERFACE -fsanitize=${_sanitizers})
endif()

# Heavy third-party template code (CGAL, ITK) under UBSan costs minutes a source: the cheap checks stay.
function(trocar_relax_sanitizer target)
  if(TROCAR_SANITIZE MATCHES "undefined")
    target_compile_options(${target} PRIVATE -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow)
  endif()
endfunction()
