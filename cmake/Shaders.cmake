# rastercheck_shader(LIST NAME FILE DEFINITIONS…): compiles the shader FILE of the current folder
# into an array of words, `spirv_NAME`, in the header NAME.h, and appends the header to LIST. The
# header lies below spirv/ in the current binary folder, under FILE's path in the source tree;
# sources include it by that path.
function(rastercheck_shader list name file)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE place)
  cmake_path(GET file PARENT_PATH below)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/spirv/${place}/${below}")
  file(MAKE_DIRECTORY "${folder}")
  set(header "${folder}/${name}.h")
  list(TRANSFORM ARGN PREPEND -D)
  add_custom_command(OUTPUT "${header}" DEPENDS "${file}" DEPFILE "${header}.d"
    COMMAND "${RASTERCHECK_GLSLANG}" --quiet --target-env vulkan1.1 ${ARGN} --vn spirv_${name}
            --depfile "${header}.d" -o "${header}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}"
    COMMENT "Compiling ${file} ${ARGN}" VERBATIM)
  set(${list} ${${list}} "${header}" PARENT_SCOPE)
endfunction()
