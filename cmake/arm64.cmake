# Cross-compiles for arm64 with Debian's crossbuild-essential-arm64, for scripts/arm64.
# RASTERCHECK_SYSROOT is a folder with Debian's arm64 packages unpacked. Programs of the build that
# have to run, such as those that list their tests, run under qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_SYSROOT "${RASTERCHECK_SYSROOT}")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L "${RASTERCHECK_SYSROOT}")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES RASTERCHECK_SYSROOT)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
