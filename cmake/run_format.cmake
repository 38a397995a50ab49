# cmake -D clang_format=PROGRAM -D root=FOLDER -D mode=ARGUMENTS -P run_format.cmake
set(sources)
foreach(room analytic pipeline sdf data tests paper_figures)
  file(GLOB_RECURSE room_sources ${root}/${room}/*.h ${root}/${room}/*.cpp)
  list(APPEND sources ${room_sources})
endforeach()

execute_process(COMMAND ${clang_format} ${mode} --style=file ${sources} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "not as clang-format would have it: run `cmake --build BUILD --target format`")
endif()
