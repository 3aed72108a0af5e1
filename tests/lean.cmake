# The tests of a build without all optional parts, or for another machine: those of libkoksma, and of the files that the
# leanest program reads and writes.
file(GLOB_RECURSE tests CONFIGURE_DEPENDS test_*.c)
foreach(test ${tests})
  file(STRINGS ${test} of_lab REGEX "include.*((image|scene|scene_files|render|rendering|study|plot|adaptive|json|meshes|density|datasheet)[/.]|stats/stats[.])")
  if(NOT of_lab)
    koksma_test(${test} koksma)
  endif()
endforeach()
if(KOKSMA_LAB)
  foreach(name byte_order points_files malformed_points generate)
    add_test(NAME cli_${name} COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/cli/run.sh ${KOKSMA_RUNNER} ${CMAKE_CURRENT_SOURCE_DIR}/cli/${name}.test)
  endforeach()
endif()
