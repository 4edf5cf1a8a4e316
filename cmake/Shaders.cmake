# rastercheck_shader(LIST NAME FILE DEFINITIONS…): the shader FILE, from the current folder, as words of an
# array `spirv_NAME` in the header NAME.h, which sources include by the path that FILE has in the tree. The
# header joins LIST; spirv/ in the current binary folder is where includes begin.
function(rastercheck_shader list name file)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE place)
  cmake_path(GET file PARENT_PATH below)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/spirv/${place}/${below}")
  file(MAKE_DIRECTORY "${folder}")
  set(header "${folder}/${name}.h")
  list(TRANSFORM ARGN PREPEND -D)
  add_custom_command(OUTPUT "${header}" DEPENDS "${file}"
    COMMAND "${RASTERCHECK_GLSLANG}" --quiet --target-env vulkan1.1 ${ARGN} --vn spirv_${name}
            -o "${header}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}"
    COMMENT "Compiling ${file} ${ARGN}" VERBATIM)
  set(${list} ${${list}} "${header}" PARENT_SCOPE)
endfunction()
