# An overlay port: vcpkg install koksma --overlay-ports=packaging/vcpkg. It builds the tree that it lies in.
set(SOURCE_PATH ${CURRENT_PORT_DIR}/../..)
if("library" IN_LIST FEATURES)
  vcpkg_cmake_configure(SOURCE_PATH ${SOURCE_PATH} OPTIONS -DKOKSMA_LAB=OFF -DBUILD_TESTING=OFF)
  vcpkg_cmake_install()
  vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/koksma)
  vcpkg_fixup_pkgconfig()
  file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include ${CURRENT_PACKAGES_DIR}/debug/share)
else()
  set(VCPKG_POLICY_EMPTY_INCLUDE_FOLDER disabled)
  file(INSTALL ${SOURCE_PATH}/include/koksma/sampler.h ${SOURCE_PATH}/include/koksma/keys.h ${SOURCE_PATH}/include/koksma/mask.h
               ${SOURCE_PATH}/include/koksma/warp.h DESTINATION ${CURRENT_PACKAGES_DIR}/include/koksma)
endif()
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE ${SOURCE_PATH}/THIRD_PARTY.md)
