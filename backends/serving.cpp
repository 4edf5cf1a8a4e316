#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "backends/factory.h"
#include "backends/internal/channel.h"
#include "backends/internal/wire.h"
#include "backends/isolation.h"
#include "cases/child_process.h"
#include "cases/confinement.h"

namespace rastercheck::backends {
namespace {

/// Any size, because messages from the parent can be trusted.
constexpr std::uint64_t kMostBytes = ~std::uint64_t{0};

/// Takes the channel that was passed as standard input and output. From now on, the input and
/// output of other code go elsewhere.
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

/// Applies all limits except that on processor time, which is set anew for each answer.
Result<void> limit(const ServingLimits& limits, const ProcessRights& rights) {
  // A file that grows too long then gives the writer an error instead of ending the process.
  if (std::signal(SIGXFSZ, SIG_IGN) == SIG_ERR || ::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) {
    return tl::unexpected(Error{"a process's signals", "", std::strerror(errno)});
  }
  if (!rights.is_confined) return {};
  const Result<cases::Confinement> confined = cases::confine_this_process();
  if (!confined) return tl::unexpected(confined.error());
  // Drivers write to shared memory, which a limit on file sizes would also restrict.
  return cases::limit_this_process({.memory = limits.memory,
                                    .may_write = confined->has_no_files,
                                    .may_reserve_memory = rights.may_reserve_memory});
}

/// Keeps memory that each drawing allocates and frees, since getting it from the system again takes
/// longer than most drawings.
void keep_memory() {
  constexpr int kMebibyte = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, 32 * kMebibyte);  // larger values are refused
  ::mallopt(M_TRIM_THRESHOLD, 512 * kMebibyte);
}

/// Returns the number of bytes that are allocated and not yet freed.
std::size_t memory_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Draws cases and answers queries. Draws the first, second, fourth, … case again, if that was
/// quick, to check for memory leaks. In a replay, the saved case is drawn first, so the check
/// covers it as well.
class WatchedDrawer {
 public:
  WatchedDrawer(Backend& backend, double seconds)
      : backend_(&backend),
        makes_promises_(!backend.about().api),
        longest_(seconds / kShareOfTime),
        longest_together_(seconds / 2) {}

  Result<Drawn> draw(const cases::Case& c, std::optional<cases::DrawBy> way) {
    return watched([&] { return draw_in(c, way); });
  }
  Result<cases::Fragments> draw_assembled(const Request& request) {
    return watched([&] {
      return backend_->assembler()->draw_assembled(request.source, request.topology,
                                                   request.indices);
    });
  }
  Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) {
    return watched([&] { return backend_->occlusion_culler()->is_occluded(c, occluders); });
  }
  Result<cases::Picture> draw_picture(const cases::Case& c, const cases::Pipeline& pipeline) {
    return watched([&] { return backend_->picture_drawer()->draw_picture(c, pipeline); });
  }

 private:
  /// Draws by `draw()`, and again if memory is to be checked.
  template <typename DrawOnce>
  auto watched(const DrawOnce& draw) -> decltype(draw()) {
    const auto start = std::chrono::steady_clock::now();
    auto drawn = draw();
    if (!drawn || !std::has_single_bit(++drawings_)) return drawn;
    if (std::chrono::steady_clock::now() - start > longest_) return drawn;
    if (const Result<void> kept = check_memory(draw); !kept) return tl::unexpected(kept.error());
    return drawn;
  }

  /// Draws in the given way, if any; fails if that way cannot draw the case. Leaves out a driver's
  /// contract, which the parent process computes.
  Result<Drawn> draw_in(const cases::Case& c, std::optional<cases::DrawBy> way) {
    WaysOfDrawing* const ways = way ? backend_->ways_of_drawing() : nullptr;
    Result<cases::Fragments> drawn =
        ways == nullptr ? backend_->draw_unjudged(c) : ways->draw_by(c, *way);
    return std::move(drawn).map([&](cases::Fragments&& fragments) {
      return Drawn{makes_promises_ ? backend_->contract(c) : cases::Contract(),
                   std::move(fragments)};
    });
  }

  /// A drawing is repeated at least kRepetitions times, because caches fill during the first few
  /// repetitions. If the last kSuspected repetitions in a row have all taken memory, a leak is
  /// suspected. The repetitions then go on until one takes no memory, which means no leak, or until
  /// kLeaking in a row have taken memory or half of the time limit is over, which means a leak. So
  /// many are needed because a driver's threads take some memory for a while, until the work is
  /// spread over all of them.
  static constexpr int kRepetitions = 8;
  static constexpr int kSuspected = 4;
  static constexpr int kLeaking = 64;
  /// Only drawings that take at most 1/kShareOfTime of the time limit for an answer are checked, so
  /// that the repetitions fit into that limit. Scenes take longer and are not checked.
  static constexpr double kShareOfTime = 200;

  template <typename DrawOnce>
  Result<void> check_memory(const DrawOnce& draw) {
    const auto start = std::chrono::steady_clock::now();
    const auto may_go_on = [&](int growing) {
      return growing >= kSuspected && growing < kLeaking &&
             std::chrono::steady_clock::now() - start < longest_together_;
    };
    std::size_t before = memory_in_use();
    std::size_t growth = 0;
    int growing = 0;
    for (int i = 0; i < kRepetitions || may_go_on(growing); ++i) {
      if (const auto again = draw(); !again) return tl::unexpected(again.error());
      const std::size_t after = memory_in_use();
      growing = after > before ? growing + 1 : 0;
      growth = after - before;
      before = after;
    }
    if (growing < kSuspected) return {};
    return tl::unexpected(Error{"", "",
                                fmt::format("it leaks memory: each time this case is drawn again, "
                                            "memory use grows, the last time by {} bytes",
                                            growth)});
  }

  Backend* backend_;
  bool makes_promises_;
  std::chrono::duration<double> longest_;
  std::chrono::duration<double> longest_together_;
  std::uint64_t drawings_ = 0;
};

std::string answer_to(const Request& request, const Backend& backend, WatchedDrawer& drawer) {
  if (request.question == Question::promise) return pack(backend.promise(request.source));
  if (request.question == Question::occlusion) {
    const Result<bool> occluded = drawer.is_occluded(request.source, request.occluders);
    if (!occluded) return pack(OcclusionAnswer{false, occluded.error()});
    return pack(OcclusionAnswer{*occluded, std::nullopt});
  }
  if (request.question == Question::picture) {
    Result<cases::Picture> picture = drawer.draw_picture(request.source, request.pipeline);
    if (!picture) return pack(PictureAnswer{{}, picture.error()});
    return pack(PictureAnswer{*std::move(picture)});
  }
  if (request.question == Question::assembly) {
    Result<cases::Fragments> fragments = drawer.draw_assembled(request);
    if (!fragments) return pack(DrawingAnswer{{}, fragments.error()});
    return pack(DrawingAnswer{Drawn{{}, *std::move(fragments)}, std::nullopt});
  }
  Result<Drawn> drawn = drawer.draw(request.source, request.way);
  if (!drawn) return pack(DrawingAnswer{{}, drawn.error()});
  return pack(DrawingAnswer{*std::move(drawn), std::nullopt});
}

}  // namespace

Result<void> serve_backend(const std::string& specification, const ServingLimits& limits) {
  const Result<Channel> channel = take_channel();
  if (!channel) return tl::unexpected(channel.error());
  keep_memory();
  // Unbuffered, so that the last words before a crash reach the parent.
  std::setvbuf(stdout, nullptr, _IONBF, 0);
  const ProcessRights rights = rights_of(specification);
  if (const Result<void> limited = limit(limits, rights); !limited) return limited;
  const std::chrono::duration<double> time_of_all(
      limits.seconds * std::max(1U, std::thread::hardware_concurrency()));
  const auto limit_time = [&]() -> Result<void> {
    if (rights.may_reserve_memory) return {};
    return cases::limit_processor_time_from_now(time_of_all);
  };

  Result<std::unique_ptr<Backend>> backend = make_backend(specification);
  Greeting greeting;
  if (backend) {
    greeting.about = (*backend)->about();
  } else {
    greeting.problem = backend.error();
  }
  if (!channel->send(pack(greeting), {}) || !backend) return {};
  (*backend)->tell_progress([&] {
    channel->beat();
    // The next part gets as much time again. If setting the limit fails, the time that is left must
    // suffice.
    static_cast<void>(limit_time());
  });
  WatchedDrawer drawer(**backend, limits.seconds);
  while (const std::optional<std::string> asked = channel->receive(kMostBytes, {})) {
    const std::optional<Request> request = unpack_request(*asked);
    if (!request) return tl::unexpected(Error{"-", "", "not a request for a drawing"});
    if (const Result<void> set = limit_time(); !set) return set;
    if (!channel->send(answer_to(*request, **backend, drawer), {})) break;
  }
  return {};
}

}  // namespace rastercheck::backends
