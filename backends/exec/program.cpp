#include "backends/exec/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "cases/json.h"

namespace rastercheck::backends {
namespace {

constexpr std::string_view kWhileStarting = "while starting";
constexpr std::string_view kWhileDrawing = "while drawing";

/// How long a program that has closed its output may take to end.
constexpr std::chrono::milliseconds kLongestEnd{1000};
/// The number of bytes per read(), and the capacity that pipes are asked to have.
constexpr std::size_t kPart = std::size_t{1} << 20U;

Error system_error(const std::string& what) { return {what, "", std::strerror(errno)}; }

Error crash(const std::string& reason) { return {"", "", reason, Failure::crash}; }

struct Pipe {
  cases::Descriptor out;
  cases::Descriptor in;
};

/// A pipe whose ends no other program inherits, and which holds more than the usual 64 KiB if the
/// system allows it.
Result<Pipe> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return tl::unexpected(system_error("pipe"));
  ::fcntl(ends[1], F_SETPIPE_SZ, static_cast<int>(kPart));
  return Pipe{cases::Descriptor(ends[0]), cases::Descriptor(ends[1])};
}

}  // namespace

Result<GrowingMemory> GrowingMemory::create() {
  cases::Descriptor file(::memfd_create("rastercheck", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  // If the program shrank the memory, this process would be killed when it next reads there.
  if (!file.is_open() || ::fcntl(file.number(), F_ADD_SEALS, F_SEAL_SHRINK) != 0) {
    return tl::unexpected(system_error("shared memory"));
  }
  return GrowingMemory(std::move(file));
}

GrowingMemory::GrowingMemory(GrowingMemory&& other) noexcept
    : file_(std::move(other.file_)),
      data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)) {}

GrowingMemory::~GrowingMemory() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

Result<void> GrowingMemory::grow(std::uint64_t size) {
  if (size <= size_) return {};
  // Rounded up to whole parts, so that it grows seldom.
  size = (size + kPart - 1) / kPart * kPart;
  if (::ftruncate(file_.number(), static_cast<off_t>(size)) != 0) {
    return tl::unexpected(system_error("shared memory"));
  }
  void* const grown = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file(), 0);
  if (grown == MAP_FAILED) return tl::unexpected(system_error("shared memory"));
  if (data_ != nullptr) ::munmap(data_, size_);
  data_ = static_cast<std::byte*>(grown);
  size_ = size;
  return {};
}

Result<Program> Program::start(const std::vector<std::string>& command) {
  // Writing to a program that has ended then fails instead of ending this process.
  std::signal(SIGPIPE, SIG_IGN);
  Result<Pipe> to = make_pipe();
  Result<Pipe> from = make_pipe();
  Result<GrowingMemory> memory = GrowingMemory::create();
  if (!to) return tl::unexpected(to.error());
  if (!from) return tl::unexpected(from.error());
  if (!memory) return tl::unexpected(memory.error());
  Result<cases::ChildProcess> process = cases::ChildProcess::start(
      command, {.input = to->out.number(), .output = from->in.number(), .fourth = memory->file()},
      cases::ProcessGroup::of_parent);
  if (!process) return tl::unexpected(process.error());
  // If these stayed open here, the program's end would never show.
  to->out.close();
  from->in.close();
  Program program(*std::move(process), std::move(to->in), std::move(from->out), *std::move(memory));
  // A program that ends at once may have said why, so its line is read even if this fails.
  static_cast<void>(program.send(our_hello() + "\n", kWhileStarting));
  const Result<std::string> line = program.line(kWhileStarting);
  if (!line) return tl::unexpected(line.error());
  Result<ProgramHello> hello = parse_hello(*line);
  if (!hello) return tl::unexpected(crash(hello.error().reason));
  program.hello_ = *std::move(hello);
  return program;
}

Result<Program::Answer> Program::draw(DrawMessage message, const cases::Case& c) {
  if (read_.size() > used_) {
    return tl::unexpected(crash(
        fmt::format("it wrote more than its answer: {}",
                    cases::json_string(cases::printable(std::string_view(read_).substr(used_))))));
  }
  const Gives gives = hello_.gives;
  MemoryPlan plan;
  if (hello_.has_shared_memory) {
    constexpr std::uint64_t kPage = 4096;
    plan.answer_at = (message.arrays.size() + kPage - 1) / kPage * kPage;
    if (const Result<void> grown =
            memory_.grow(plan.answer_at + answer_bytes(gives, c, message.samples));
        !grown) {
      return tl::unexpected(grown.error());
    }
    plan.size = memory_.size();
    add_memory(message, plan);
    std::memcpy(memory_.data(), message.arrays.data(), message.arrays.size());
    message.arrays.clear();
  }
  message.header += '\n';
  // Written together, so that the program wakes up once for a small draw.
  message.header += message.arrays;
  if (Result<void> sent = send(message.header, kWhileDrawing); !sent) {
    return tl::unexpected(sent.error());
  }
  const Result<std::string> first = line(kWhileDrawing);
  if (!first) return tl::unexpected(first.error());
  const Result<AnswerHeader> header = parse_answer(*first, gives, c);
  if (!header) return tl::unexpected(crash(header.error().reason));
  if (hello_.has_shared_memory) {
    return Answer{*header,
                  {reinterpret_cast<const char*>(memory_.data()) + plan.answer_at, header->bytes}};
  }
  return arrays(header->bytes).map([&](std::string_view bytes) { return Answer{*header, bytes}; });
}

/// Writes to the program. Whatever the program writes meanwhile is kept, so that neither waits for
/// the other forever.
Result<void> Program::send(std::string_view bytes, std::string_view doing) {
  while (!bytes.empty()) {
    std::array<pollfd, 2> ends{{{to_.number(), POLLOUT, 0}, {from_.number(), POLLIN, 0}}};
    if (::poll(ends.data(), ends.size(), -1) < 0 && errno != EINTR) {
      return tl::unexpected(system_error("poll"));
    }
    if ((ends[1].revents & POLLIN) != 0) {
      if (Result<void> more = read_more(kLongestLine, doing); !more) return more;
      if (read_.size() > kLongestLine) {
        return tl::unexpected(crash("it answered before it had read what it was asked"));
      }
    }
    if ((ends[0].revents & POLLERR) != 0) return tl::unexpected(loss(doing));
    if ((ends[0].revents & POLLOUT) == 0) continue;
    // Pipes are written in parts of at most this many bytes, so that write() does not wait.
    const ssize_t count =
        ::write(to_.number(), bytes.data(), std::min<std::size_t>(bytes.size(), PIPE_BUF));
    if (count < 0 && errno != EINTR) return tl::unexpected(loss(doing));
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

Result<void> Program::read_more(std::size_t most, std::string_view doing) {
  if (used_ == read_.size()) {
    read_.clear();
    used_ = 0;
  }
  const std::size_t had = read_.size();
  read_.resize(had + most);
  ssize_t count = 0;
  do {
    count = ::read(from_.number(), read_.data() + had, most);
  } while (count < 0 && errno == EINTR);
  read_.resize(had + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  if (count <= 0) return tl::unexpected(loss(doing));
  return {};
}

Result<std::string> Program::line(std::string_view doing) {
  for (;;) {
    const std::size_t end = read_.find('\n', used_);
    if (end != std::string::npos) {
      std::string line = read_.substr(used_, end - used_);
      used_ = end + 1;
      return line;
    }
    if (read_.size() - used_ > kLongestLine) {
      return tl::unexpected(
          crash(fmt::format("it wrote a line of more than {} bytes; what is no answer belongs on "
                            "standard error",
                            kLongestLine)));
    }
    if (Result<void> more = read_more(kLongestLine, doing); !more) {
      return tl::unexpected(more.error());
    }
  }
}

Result<std::string_view> Program::arrays(std::uint64_t bytes) {
  while (read_.size() - used_ < bytes) {
    const std::uint64_t left = bytes - (read_.size() - used_);
    if (Result<void> more = read_more(std::min<std::uint64_t>(left, kPart), kWhileDrawing); !more) {
      Error lost = more.error();
      lost.reason +=
          fmt::format("; its answer ends after {} of {} bytes", read_.size() - used_, bytes);
      return tl::unexpected(lost);
    }
  }
  const std::string_view all = std::string_view(read_).substr(used_, bytes);
  used_ += bytes;
  return all;
}

/// Ends a program that has closed its input or output, and says how it ended.
Error Program::loss(std::string_view doing) {
  const bool has_ended = process_.has_ended_within(kLongestEnd);
  process_.kill();
  const cases::ProcessEnd end = process_.wait();
  const std::string how =
      has_ended ? to_string(end) : std::string("closed its standard input or output");
  return crash(fmt::format("its program {} {}", how, doing));
}

}  // namespace rastercheck::backends
