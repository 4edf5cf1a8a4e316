# rastercheck_tests(FOLDER SOURCES…): the GoogleTest program of one folder's tests, each test a
# CTest test labelled with the folder. It sees the folder's internal headers, as only it may. The whole
# library is linked, so that nothing that registers itself is dropped. RapidCheck's properties start
# from one seed, so that the same commit has the same result; run the program itself for other seeds.
include(GoogleTest)
function(rastercheck_tests folder)
  add_executable(rastercheck_tests_${folder} ${ARGN})
  target_link_libraries(rastercheck_tests_${folder} PRIVATE
    $<LINK_LIBRARY:WHOLE_ARCHIVE,RasterCheck::${folder}> rapidcheck GTest::gmock GTest::gtest_main)
  target_compile_definitions(rastercheck_tests_${folder} PRIVATE
    RASTERCHECK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gtest_discover_tests(rastercheck_tests_${folder}
    TEST_PREFIX "${folder}." PROPERTIES LABELS ${folder} ENVIRONMENT RC_PARAMS=seed=1 DISCOVERY_TIMEOUT 60)
endfunction()
