# SPDX-License-Identifier: MIT
# Run by cpack once the components are staged. In Debian packages the documents of a package lie in a folder of its name:
# `copyright`, the compressed change log; pages of the manual are compressed, programs stripped.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
    return()
endif()

function(must)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(package IN LISTS CPACK_SIVID_PACKAGES)
    string(TOUPPER "${package}" upper)
    set(name "${CPACK_DEBIAN_${upper}_PACKAGE_NAME}")
    set(root "${CPACK_TEMPORARY_DIRECTORY}/${package}${CPACK_PACKAGING_INSTALL_PREFIX}")
    set(documents "${root}/share/doc/sivid")
    if(NOT EXISTS "${documents}/LICENSE")
        message(FATAL_ERROR "nothing of ${package} is staged in ${root}")
    endif()
    if(NOT name STREQUAL "sivid")
        file(RENAME "${documents}" "${root}/share/doc/${name}")
        set(documents "${root}/share/doc/${name}")
    endif()
    file(READ "${documents}/LICENSE" licence)
    string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
    string(REGEX REPLACE "\n([^\n])" "\n \\1" licence "${licence}")
    string(REGEX MATCH "Copyright[^\n]*" copyright "${licence}")
    string(REGEX REPLACE "Copyright *(\\([cC]\\))? *" "" copyright "${copyright}")
    file(REMOVE "${documents}/LICENSE")
    file(WRITE "${documents}/copyright" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: sivid

Files: *
Copyright: ${copyright}
License: Expat
 ${licence}")
    string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)   # of SOURCE_DATE_EPOCH, where that is set
    file(WRITE "${documents}/changelog.Debian"
"sivid (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Built by CPack from the sources; what changed: changelog.gz

 -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
    file(RENAME "${documents}/CHANGELOG.md" "${documents}/changelog")
    must(gzip -9 -n "${documents}/changelog" "${documents}/changelog.Debian")
    file(GLOB pages "${root}/share/man/man1/*.1")
    if(pages)
        must(gzip -9 -n ${pages})
    endif()
    file(GLOB programs "${root}/bin/*")
    foreach(program IN LISTS programs)
        file(RPATH_REMOVE FILE "${program}")   # the loader knows where Debian's libraries are
    endforeach()
    file(GLOB_RECURSE libraries "${root}/lib*/*.so.*" "${root}/lib*/*.so")
    foreach(file IN LISTS programs libraries)
        if(NOT IS_SYMLINK "${file}")
            must("${CPACK_SIVID_STRIP}" --strip-unneeded --remove-section=.comment --remove-section=.note "${file}")
        endif()
    endforeach()
    if(package STREQUAL "sivid_programs" AND NOT programs)
        message(FATAL_ERROR "no program is built: cmake --build <build> --target hovercraft sivid")
    endif()
endforeach()
