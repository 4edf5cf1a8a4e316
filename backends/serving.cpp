#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <memory>
#include <thread>

#include "backends/internal/channel.h"
#include "backends/internal/wire.h"
#include "backends/isolation.h"
#include "cases/child_process.h"
#include "cases/confinement.h"

namespace rastercheck::backends {
namespace {

/// Of no more than what a parent sends, which is none of the dangers here.
constexpr std::uint64_t kMostBytes = ~std::uint64_t{0};

/// The channel that was handed over as standard input and output; what others read and print from
/// now on goes elsewhere.
Result<Channel> take_channel() {
  Result<cases::Descriptor> memory = cases::take_standard_output();
  if (!memory) return tl::unexpected(memory.error());
  cases::Descriptor bell(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3));
  const cases::Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  if (!bell.is_open() || !nothing.is_open() || ::dup2(nothing.number(), STDIN_FILENO) < 0) {
    return tl::unexpected(Error{"standard input", "", std::strerror(errno)});
  }
  Result<SharedMemory> shared = SharedMemory::open(*std::move(memory), Channel::memory_size());
  if (!shared) return tl::unexpected(shared.error());
  return Channel(*std::move(shared), std::move(bell));
}

/// All but processor time, which is for each answer.
Result<void> limit(const ServingLimits& limits) {
  // An error of whoever writes, not the end of the process.
  if (std::signal(SIGXFSZ, SIG_IGN) == SIG_ERR || ::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) {
    return tl::unexpected(Error{"a process's signals", "", std::strerror(errno)});
  }
  return cases::limit_this_process({.memory = limits.memory}).and_then([]() -> Result<void> {
    const Result<cases::Confinement> confined = cases::confine_this_process();
    if (!confined) return tl::unexpected(confined.error());
    return {};
  });
}

std::string answer_to(const Request& request, Backend& backend) {
  if (request.question == Question::contract) return pack(backend.contract(request.source));
  Result<cases::Framebuffer> drawn = backend.draw(request.source);
  if (!drawn) return pack(Drawing{{}, drawn.error()});
  return pack(Drawing{*std::move(drawn), std::nullopt});
}

}  // namespace

Result<void> serve_backend(const std::string& specification, const ServingLimits& limits) {
  const Result<Channel> channel = take_channel();
  if (!channel) return tl::unexpected(channel.error());
  if (const Result<void> limited = limit(limits); !limited) return limited;
  const std::chrono::duration<double> time_of_all(
      limits.seconds * std::max(1U, std::thread::hardware_concurrency()));

  Result<std::unique_ptr<Backend>> backend = make_backend(specification);
  Greeting greeting;
  if (backend) {
    greeting = {(*backend)->description(), (*backend)->has_limits(), std::nullopt};
  } else {
    greeting.problem = backend.error();
  }
  if (!channel->send(pack(greeting), {}) || !backend) return {};
  while (const std::optional<std::string> asked = channel->receive(kMostBytes, {})) {
    const std::optional<Request> request = unpack_request(*asked);
    if (!request) return tl::unexpected(Error{"-", "", "not a request of a drawing"});
    if (const auto set = cases::limit_processor_time_from_now(time_of_all); !set) return set;
    if (!channel->send(answer_to(*request, **backend), {})) break;
  }
  return {};
}

}  // namespace rastercheck::backends
