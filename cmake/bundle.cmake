# Run by the install step of pip's build: makes the package self-contained. Copies every library that the package's own need
# into their folder, but those of the C and C++ compilers' systems, and puts the copyright files of their Debian packages beside
# them. A copy gets a name of its own (libpng16.so.16 becomes libpng16-koksma.so.16), so that a process may hold another version
# of it, and whoever needs it is made to look for that name beside itself ($ORIGIN).
# In: KOKSMA_LIB (the folder), KOKSMA_PARTS (files in it), KOKSMA_PATCHELF.
list(TRANSFORM KOKSMA_PARTS PREPEND ${KOKSMA_LIB}/)

file(GET_RUNTIME_DEPENDENCIES LIBRARIES ${KOKSMA_PARTS} RESOLVED_DEPENDENCIES_VAR found UNRESOLVED_DEPENDENCIES_VAR missing
     PRE_EXCLUDE_REGEXES "^libkoksma" "^ld-linux" "^linux-vdso" "^lib(c|m|dl|rt|pthread|util|resolv|mvec)\\.so" "^libstdc\\+\\+\\."
                         "^libgcc_s\\.")
if(missing)
  message(FATAL_ERROR "the package can't be made self-contained: these libraries are not found: ${missing}")
endif()

set(replacements "")
set(files ${KOKSMA_PARTS})
foreach(library ${found})
  cmake_path(GET library FILENAME name)
  string(REGEX REPLACE "\\.so" "-koksma.so" own ${name})
  file(REAL_PATH ${library} real)
  file(COPY_FILE ${real} ${KOKSMA_LIB}/${own})
  file(CHMOD ${KOKSMA_LIB}/${own} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  execute_process(COMMAND ${KOKSMA_PATCHELF} --set-soname ${own} ${KOKSMA_LIB}/${own} COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND replacements --replace-needed ${name} ${own})
  list(APPEND files ${KOKSMA_LIB}/${own})

  # dpkg knows a library by its path before or after /usr was merged.
  string(REGEX REPLACE "^/usr" "" short ${real})
  execute_process(COMMAND dpkg-query -S ${real} ${short} OUTPUT_VARIABLE owner ERROR_QUIET)
  string(REGEX REPLACE ":.*" "" package "${owner}")
  if(package AND EXISTS /usr/share/doc/${package}/copyright)
    configure_file(/usr/share/doc/${package}/copyright ${KOKSMA_LIB}/licences/${package}.txt COPYONLY)
  else()
    message(WARNING "the licence of ${real} is not known to dpkg: the package holds the library without it")
  endif()
endforeach()
foreach(file ${files})
  execute_process(COMMAND ${KOKSMA_PATCHELF} ${replacements} --set-rpath $ORIGIN ${file} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
