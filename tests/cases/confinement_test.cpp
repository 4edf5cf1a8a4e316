#include "cases/confinement.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace rastercheck::cases::confinement_test {
namespace {

/// Exits with 0 if the confined process can do everything that it should and nothing that it should
/// not; otherwise exits with the number of the fault.
[[noreturn]] void try_all(const std::string& folder) {
  const Result<Confinement> confined = confine_this_process();
  if (!confined) ::_exit(1);
  if (::open((folder + "/old").c_str(), O_RDONLY) < 0) ::_exit(2);
  if (::open("/dev/null", O_WRONLY) < 0) ::_exit(3);
  if (::socket(AF_UNIX, SOCK_STREAM, 0) < 0) ::_exit(4);
  if (confined->has_no_files) {
    if (::open((folder + "/new").c_str(), O_WRONLY | O_CREAT, 0600) >= 0) ::_exit(5);
    if (::open((folder + "/old").c_str(), O_WRONLY) >= 0) ::_exit(6);
    if (::unlink((folder + "/old").c_str()) == 0) ::_exit(7);
    if (::mkdir((folder + "/sub").c_str(), 0700) == 0) ::_exit(8);
  }
  if (confined->has_no_network) {
    if (::socket(AF_INET, SOCK_STREAM, 0) >= 0 || errno != EACCES) ::_exit(9);
    if (::socket(AF_INET6, SOCK_DGRAM, 0) >= 0) ::_exit(10);
  }
  ::_exit(0);
}

using ConfinementDeathTest = testing::Test;

TEST(ConfinementDeathTest, LeavesWhatADrawingNeeds) {
  const TemporaryFolder folder;
  folder.put("old", "content");
  EXPECT_EXIT(try_all(folder.path()), testing::ExitedWithCode(0), "");
  EXPECT_EQ(folder.content("old"), "content");
  EXPECT_EQ(folder.files(), std::vector<std::string>{"old"});
}

}  // namespace
}  // namespace rastercheck::cases::confinement_test
