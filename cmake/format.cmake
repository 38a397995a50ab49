# `ninja format` rewrites our sources by .clang-format; add_format_test() adds the test that nothing is left to rewrite.
find_program(CLANG_FORMAT clang-format)
mark_as_advanced(CLANG_FORMAT)

set(EDGEWISE_FORMAT_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/run_format.cmake)
set(EDGEWISE_FORMAT_COMMAND ${CMAKE_COMMAND} -D clang_format=${CLANG_FORMAT} -D root=${PROJECT_SOURCE_DIR})

if(CLANG_FORMAT)
  add_custom_target(format COMMAND ${EDGEWISE_FORMAT_COMMAND} -D mode=-i -P ${EDGEWISE_FORMAT_SCRIPT} VERBATIM)
endif()

function(add_format_test)
  if(CLANG_FORMAT)
    add_test(NAME format
      COMMAND ${EDGEWISE_FORMAT_COMMAND} "-Dmode=--dry-run;-Werror" -P ${EDGEWISE_FORMAT_SCRIPT})
  endif()
endfunction()
