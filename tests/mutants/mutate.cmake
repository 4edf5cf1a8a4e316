# Copies FILES (comma-separated, relative to SOURCE) into TREE and applies PATCH there. A patch that
# does not fit exactly ends the build: a mutant that was not applied would be no mutant.

string(REPLACE "," ";" FILES "${FILES}")
file(REMOVE_RECURSE ${TREE})
foreach(file IN LISTS FILES)
  cmake_path(GET file PARENT_PATH folder)
  file(MAKE_DIRECTORY ${TREE}/${folder})
  file(COPY_FILE ${SOURCE}/${file} ${TREE}/${file})
endforeach()

execute_process(
  COMMAND ${PATCH_PROGRAM} --fuzz=0 -p1 --batch --forward --no-backup-if-mismatch --reject-file=-
          --input=${PATCH}
  WORKING_DIRECTORY ${TREE}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  # Leaves nothing that a later build could take for the result.
  file(REMOVE_RECURSE ${TREE})
  message(FATAL_ERROR "${PATCH} does not fit the sources any more. Make it anew "
    "(docs/adding-a-mutant.md).\n${output}")
endif()
