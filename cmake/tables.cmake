# The tables (patterns.def and its like) are the build lists: one line a member, one file a line.

# koksma_table(RESULT FOLDER MACRO): the sources FOLDER/<name>.c of the lines MACRO(<name>) of FOLDER/*.def.
# A line without a file, or a file without a line, stops here.
function(koksma_table result folder macro table)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${table})
  file(STRINGS ${folder}/${table} lines REGEX "^${macro}\\(")
  set(sources)
  foreach(line ${lines})
    string(REGEX REPLACE "^${macro}\\(([a-z0-9_]+).*" "\\1" name "${line}")
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${ARGV4}${name}.c)
      message(FATAL_ERROR "${folder}/${table} names ${name}, and there is no ${folder}/${ARGV4}${name}.c")
    endif()
    list(APPEND sources ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${ARGV4}${name}.c)
  endforeach()
  file(GLOB present CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.c)
  foreach(source ${present})
    get_filename_component(name ${source} NAME)
    if(NOT source IN_LIST sources AND NOT name IN_LIST ARGN)
      message(FATAL_ERROR "${folder}/${name} has no line in ${folder}/${table}")
    endif()
  endforeach()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()
