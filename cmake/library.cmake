# SPDX-License-Identifier: MIT
# sivid::library and sivid::library_static: libsivid, the objects of sivid::compiled and sivid::app linked once, for programs
# of any compiler with any machine flags. It shows what impl/*.ipp define and hides all else, so that nothing of a program
# takes the place of something inside. For each level of SIVID_LIBRARY_LEVELS there is the same library compiled for those
# machines, in glibc-hwcaps/LEVEL beside it: the loader takes the best that the machine has. All have the same bits.
#
# Included by sivid's own tree behind app.cmake, where SIVID_LIBRARY is on.

if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR SIVID_NATIVE OR SIVID_SANITIZE OR "${CMAKE_CXX_FLAGS}" MATCHES "-march=")
    message(FATAL_ERROR "SIVID_LIBRARY is for Linux, any machine (no SIVID_NATIVE, no -march=) and without sanitizers")
endif()

find_package(Threads REQUIRED)
set(sivid_library_parts sivid_compiled)
set(sivid_library_needs "")   # the libraries behind it, by their names for the linker
foreach(part IN ITEMS sivid_compiled_mpfi sivid_app)
    if(TARGET ${part})
        list(APPEND sivid_library_parts ${part})
    endif()
endforeach()
if(TARGET sivid::compiled_mpfi)
    list(APPEND sivid_library_needs mpfi mpfr gmp)
endif()
if(TARGET sivid::app AND TARGET sivid::parallel)
    list(APPEND sivid_library_needs tbb)
endif()
if(TARGET sivid::app AND TARGET sivid::matlab)
    list(APPEND sivid_library_needs matio z)
endif()
if(TARGET sivid::app AND TARGET sivid::xml)
    list(APPEND sivid_library_needs expat)
endif()
if(TARGET sivid::app AND TARGET sivid::urdf)
    list(APPEND sivid_library_needs urdfdom_model tinyxml console_bridge)
endif()

# What a program is told, beside the folders of headers: layouts of Eigen's that no flag of the machine changes.
set(sivid_library_definitions SIVID_COMPILED SIVID_LIBRARY EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MAX_STATIC_ALIGN_BYTES=16)
if(TARGET sivid::compiled_mpfi)
    list(APPEND sivid_library_definitions SIVID_COMPILED_MPFI)
endif()

set(shown "${CMAKE_CURRENT_BINARY_DIR}/sivid_library/shown.map")
file(CONFIGURE OUTPUT "${shown}" CONTENT "{ global: _ZN*5sivid*; local: *; };\n" @ONLY)

# sivid_add_library_of(<target> <object>...): one libsivid.so.
function(sivid_add_library_of target)
    add_library(${target} SHARED ${ARGN})
    set_target_properties(${target} PROPERTIES OUTPUT_NAME sivid VERSION ${PROJECT_VERSION}
                          SOVERSION ${PROJECT_VERSION_MAJOR} LINKER_LANGUAGE CXX LINK_DEPENDS "${shown}")
    target_link_options(${target} PRIVATE -Wl,-Bsymbolic "-Wl,--version-script=${shown}" -Wl,--no-undefined)
    target_link_libraries(${target} PRIVATE Threads::Threads ${sivid_library_needs})
endfunction()

# sivid_compile_again(<part> <name> <option>...): the objects of a part anew, as target <part>_<name>.
function(sivid_compile_again part name)
    foreach(property IN ITEMS SOURCES LINK_LIBRARIES COMPILE_DEFINITIONS INCLUDE_DIRECTORIES)
        get_target_property(${property} ${part} ${property})
        if(NOT ${property})
            set(${property} "")
        endif()
    endforeach()
    add_library(${part}_${name} OBJECT EXCLUDE_FROM_ALL ${SOURCES})
    target_link_libraries(${part}_${name} PRIVATE ${LINK_LIBRARIES})
    target_compile_definitions(${part}_${name} PRIVATE ${COMPILE_DEFINITIONS})
    target_include_directories(${part}_${name} SYSTEM PRIVATE ${INCLUDE_DIRECTORIES})
    target_compile_options(${part}_${name} PRIVATE ${sivid_own_statics} ${ARGN})
    set_target_properties(${part}_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
endfunction()

set(objects "")
# GCC makes what inline functions keep one for a whole program: in the static library it would stand twice.
set(sivid_own_statics $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
foreach(part IN LISTS sivid_library_parts)
    target_compile_options(${part} PRIVATE ${sivid_own_statics})
    list(APPEND objects "$<TARGET_OBJECTS:${part}>")
endforeach()
sivid_add_library_of(sivid_library ${objects})

# One object, of which hidden symbols are local: in a static library, too, nothing of a program takes their place.
find_program(SIVID_LD NAMES ld.bfd ld DOC "The linker of binutils, which joins objects" REQUIRED)
mark_as_advanced(SIVID_LD)
set(object "${CMAKE_CURRENT_BINARY_DIR}/sivid_library/sivid${CMAKE_CXX_OUTPUT_EXTENSION}")
add_custom_command(OUTPUT "${object}"
    COMMAND "${SIVID_LD}" -r --force-group-allocation -o "${object}" ${objects}
    COMMAND "${CMAKE_OBJCOPY}" --localize-hidden "${object}"
    DEPENDS ${sivid_library_parts} ${objects} COMMAND_EXPAND_LISTS VERBATIM)
set_source_files_properties("${object}" PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
add_library(sivid_library_static STATIC "${object}")
set_target_properties(sivid_library_static PROPERTIES OUTPUT_NAME sivid LINKER_LANGUAGE CXX)
target_link_libraries(sivid_library_static INTERFACE ${sivid_library_needs} pthread)

foreach(library IN ITEMS library library_static)
    add_library(sivid::${library} ALIAS sivid_${library})
    set_target_properties(sivid_${library} PROPERTIES EXPORT_NAME ${library})
    target_compile_definitions(sivid_${library} INTERFACE ${sivid_library_definitions})
    target_link_libraries(sivid_${library} INTERFACE sivid_sivid)
    foreach(component IN ITEMS io verifier importing report text app_headers)   # installed: those that are found then
        if(TARGET sivid::${component})
            target_link_libraries(sivid_${library} INTERFACE $<BUILD_INTERFACE:sivid_${component}>)
        endif()
    endforeach()
endforeach()

foreach(level IN LISTS SIVID_LIBRARY_LEVELS)   # the same for further machines
    set(objects "")
    foreach(part IN LISTS sivid_library_parts)
        sivid_compile_again(${part} ${level} "-march=${level}")
        list(APPEND objects "$<TARGET_OBJECTS:${part}_${level}>")
    endforeach()
    sivid_add_library_of(sivid_library_${level} ${objects})
    set_target_properties(sivid_library_${level} PROPERTIES
        LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/glibc-hwcaps/${level}")
endforeach()

add_custom_target(libsivid DEPENDS sivid_library sivid_library_static)   # all that is installed
foreach(level IN LISTS SIVID_LIBRARY_LEVELS)
    add_dependencies(libsivid sivid_library_${level})
endforeach()

if(NOT SIVID_INSTALL)
    return()
endif()
install(TARGETS sivid_library EXPORT sivid_library_targets
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT sivid_library NAMELINK_COMPONENT sivid_linking)
foreach(level IN LISTS SIVID_LIBRARY_LEVELS)
    install(TARGETS sivid_library_${level} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/glibc-hwcaps/${level}"
            COMPONENT sivid_library NAMELINK_SKIP)
endforeach()
install(TARGETS sivid_library_static EXPORT sivid_library_targets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT sivid_linking)
install(EXPORT sivid_library_targets NAMESPACE sivid:: DESTINATION "${sivid_library_package_dir}"
        COMPONENT sivid_linking)
sivid_install_documents(sivid_library)

sivid_pkgconfig_folders("${CMAKE_INSTALL_LIBDIR}/pkgconfig")
set(cflags ${sivid_library_definitions})
list(TRANSFORM cflags PREPEND "-D")
list(JOIN cflags " " cflags)
set(behind ${sivid_library_needs} pthread)
list(TRANSFORM behind PREPEND "-l")
list(JOIN behind " " behind)
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/sivid-library.pc" @ONLY CONTENT
"prefix=@prefix@
libdir=@libdir@

Name: sivid-library
Description: libsivid, in which the expensive parts of sivid are compiled
Version: @PROJECT_VERSION@
Requires: sivid = @PROJECT_VERSION@
Cflags: @cflags@
Libs: -L\${libdir} -lsivid
Libs.private: @behind@
")
install(FILES "${PROJECT_BINARY_DIR}/sivid-library.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT sivid_linking)
