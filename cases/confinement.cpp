#include "cases/confinement.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

#include "cases/child_process.h"

namespace rastercheck::cases {
namespace {

/// The rights of Landlock's first version that allow changing files.
constexpr std::uint64_t kWriting = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                                   LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                                   LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                                   LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                                   LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
/// The right to truncate(), from Landlock's third version; Debian 12's header lacks it.
constexpr std::uint64_t kTruncating = 1U << 14U;
constexpr int kVersionOfTruncating = 3;

tl::unexpected<Error> confinement_failure(const std::string& what, int problem) {
  return tl::unexpected(Error{what, "", std::strerror(problem)});
}

/// The C library has no wrapper for this system call.
int create_ruleset(const landlock_ruleset_attr* attributes, std::size_t size, std::uint32_t flags) {
  return static_cast<int>(::syscall(SYS_landlock_create_ruleset, attributes, size, flags));
}

/// Keeps the rights `access` for everything below /dev, because drivers write to their devices
/// there and to named shared memory (/dev/shm).
Result<void> allow_devices(const Descriptor& ruleset, std::uint64_t access) {
  const Descriptor devices(::open("/dev", O_PATH | O_CLOEXEC));
  if (!devices.is_open()) return confinement_failure("/dev", errno);
  landlock_path_beneath_attr rule{};
  rule.allowed_access = access;
  rule.parent_fd = devices.number();
  if (::syscall(SYS_landlock_add_rule, ruleset.number(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) !=
      0) {
    return confinement_failure("landlock_add_rule", errno);
  }
  return {};
}

/// Drops the right to write files; returns false if the system has no Landlock.
Result<bool> take_files() {
  const int version = create_ruleset(nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return false;
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = kWriting | (version >= kVersionOfTruncating ? kTruncating : 0);
  const Descriptor ruleset(create_ruleset(&attributes, sizeof attributes, 0));
  if (!ruleset.is_open()) return confinement_failure("landlock_create_ruleset", errno);
  if (const Result<void> allowed = allow_devices(ruleset, attributes.handled_access_fs); !allowed) {
    return tl::unexpected(allowed.error());
  }
  if (::syscall(SYS_landlock_restrict_self, ruleset.number(), 0) != 0) {
    return confinement_failure("landlock_restrict_self", errno);
  }
  return true;
}

/// Drops access to networks; returns false if the system has no filters.
Result<bool> take_networks() {
  const std::unique_ptr<void, decltype(&seccomp_release)> filter(::seccomp_init(SCMP_ACT_ALLOW),
                                                                 &seccomp_release);
  if (!filter) return confinement_failure("seccomp_init", ENOMEM);
  for (const int family : {AF_INET, AF_INET6}) {
    scmp_arg_cmp is_family{};
    is_family.arg = 0;
    is_family.op = SCMP_CMP_EQ;
    is_family.datum_a = static_cast<scmp_datum_t>(family);
    const int problem = ::seccomp_rule_add_array(filter.get(), SCMP_ACT_ERRNO(EACCES),
                                                 SCMP_SYS(socket), 1, &is_family);
    if (problem != 0) return confinement_failure("seccomp_rule_add", -problem);
  }
  return ::seccomp_load(filter.get()) == 0;
}

}  // namespace

Result<Confinement> confine_this_process() {
  // Without this setting, only the superuser may drop rights.
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return confinement_failure("prctl", errno);
  const Result<bool> files = take_files();
  if (!files) return tl::unexpected(files.error());
  const Result<bool> networks = take_networks();
  if (!networks) return tl::unexpected(networks.error());
  return Confinement{*files, *networks};
}

}  // namespace rastercheck::cases
