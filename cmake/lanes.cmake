# One text, built for several instruction sets: PREFIX_scalar.cpp, _sse2, _avx2 and _avx512. CHOOSER.cpp takes one at run
# time. Their bits agree: no contraction. Leaves in SOURCES what this processor's compiler can build.
function(edgewise_lanes prefix chooser sources)
  set(options -fno-math-errno -fno-trapping-math -Wno-psabi)
  foreach(isa scalar sse2 avx2 avx512)
    set_source_files_properties(${prefix}_${isa}.cpp PROPERTIES COMPILE_OPTIONS "${options}")
  endforeach()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(${prefix}_avx2.cpp PROPERTIES COMPILE_OPTIONS "${options};-mavx2")
    set_source_files_properties(${prefix}_avx512.cpp PROPERTIES COMPILE_OPTIONS
      "${options};-mavx512f;-mavx512dq;-mavx512vl;-mprefer-vector-width=512")
    set_source_files_properties(${chooser}.cpp PROPERTIES COMPILE_DEFINITIONS EDGEWISE_HAS_AVX)
  else()
    list(FILTER ${sources} EXCLUDE REGEX "${prefix}_avx")
    set(${sources} ${${sources}} PARENT_SCOPE)
  endif()
endfunction()
