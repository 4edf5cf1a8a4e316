// Mesh files as `rastercheck import` reads them: by assimp, in a separate process, which may crash
// although this one may not. An input is the name of the format on a line of its own ("obj"),
// followed by the file.

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cases/mesh.h"
#include "cases/mesh_process.h"
#include "tests/fuzz/target.h"

namespace {

using namespace rastercheck;
using fuzz::expect;

/// Limits that are large enough for such small files.
constexpr cases::ProcessLimits kLimits{std::uint64_t{1} << 30U, 5};

/// Makes a file with this content the standard input of this process and of its children.
void set_standard_input(std::string_view content) {
  const int file = ::memfd_create("input", 0);
  const auto size = static_cast<ssize_t>(content.size());
  expect(file >= 0 && ::write(file, content.data(), content.size()) == size &&
             ::lseek(file, 0, SEEK_SET) == 0 && ::dup2(file, STDIN_FILENO) >= 0,
         "the input can be handed on");
  ::close(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = fuzz::text_of(data, size);
  const std::size_t end = std::min(input.find('\n'), input.size());
  // An argument of a command line ends at a NUL byte.
  const std::string format(input.substr(0, std::min(input.find('\0'), end)));
  set_standard_input(input.substr(std::min(end + 1, input.size())));
  std::vector<std::string> command{RASTERCHECK_PROGRAM, "mesh",
                                   "--memory=" + std::to_string(kLimits.memory),
                                   "--seconds=" + std::to_string(kLimits.seconds)};
  if (!format.empty()) command.push_back("--format=" + format);
  command.insert(command.end(), {"--", "-"});
  const Result<cases::Mesh> mesh = cases::mesh_of_process(command, "input", kLimits);
  const Result<cases::Imported> made =
      mesh.and_then([](const cases::Mesh& read) { return cases::case_of_mesh(read, "input", {}); });
  if (made) {
    fuzz::expect_round_trip(made->drawn);
  } else {
    fuzz::expect_one_line(made.error());
  }
  return 0;
}
