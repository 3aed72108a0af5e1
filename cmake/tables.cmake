# The tables (patterns.def and its like) are the build lists: one line a member, one file a line.

# koksma_table(RESULT FOLDER MACRO TABLE PREFIX OTHERS...): the sources of the lines of FOLDER/TABLE. A line MACRO(name)
# is FOLDER/<PREFIX>name.c; members that differ in constants share a file: MACRO_OF(name, file) is FOLDER/<PREFIX>file.c.
# Capitals of a name are small letters in its file's. A line without a file, or a file that is neither in a line nor one of
# OTHERS, stops here.
function(koksma_table result folder macro table prefix)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${folder}/${table})
  file(READ ${folder}/${table} text)
  string(REGEX MATCHALL "\n${macro}(_OF\\([a-z0-9_]+, *|\\()[A-Za-z0-9_]+" lines "${text}")
  set(sources)
  foreach(line ${lines})
    string(REGEX REPLACE ".*[( ]" "" name "${line}")
    string(TOLOWER "${name}" name)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${prefix}${name}.c)
      message(FATAL_ERROR "${folder}/${table} names ${name}, and there is no ${folder}/${prefix}${name}.c")
    endif()
    list(APPEND sources ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${prefix}${name}.c)
  endforeach()
  list(REMOVE_DUPLICATES sources)
  file(GLOB present CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.c)
  foreach(source ${present})
    get_filename_component(name ${source} NAME)
    if(NOT source IN_LIST sources AND NOT name IN_LIST ARGN)
      message(FATAL_ERROR "${folder}/${name} has no line in ${folder}/${table}")
    endif()
  endforeach()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()
