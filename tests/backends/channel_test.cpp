#include "backends/internal/channel.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace rastercheck::backends::channel_test {
namespace {

/// Both ends of a channel, in one process.
struct Ends {
  Channel ours;
  Channel theirs;
};

Ends make_ends() {
  std::array<int, 2> bells{};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, bells.data()), 0);
  Result<SharedMemory> memory = SharedMemory::create(Channel::memory_size());
  Result<SharedMemory> same =
      SharedMemory::open(cases::Descriptor(::dup(memory->file())), Channel::memory_size());
  return {Channel(*std::move(memory), cases::Descriptor(bells[0])),
          Channel(*std::move(same), cases::Descriptor(bells[1]))};
}

constexpr std::uint64_t kPlenty = 1U << 30U;

/// The message that the other end receives and sends back.
std::optional<std::string> echoed(const std::string& message) {
  const Ends ends = make_ends();
  std::thread other([&ends] {
    const std::optional<std::string> got = ends.theirs.receive(kPlenty, {});
    if (got) ends.theirs.send(*got, {});
  });
  std::optional<std::string> back;
  if (ends.ours.send(message, {})) back = ends.ours.receive(kPlenty, {});
  other.join();
  return back;
}

TEST(Channel, BringsMessagesOfAnyLength) {
  EXPECT_EQ(echoed(""), "");
  EXPECT_EQ(echoed("a"), "a");
  const std::size_t whole = Channel::memory_size();
  for (const std::size_t size : {whole - 25, whole - 24, whole - 23, 3 * whole + 5}) {
    std::string message(size, '\0');
    for (std::size_t i = 0; i < size; ++i) message[i] = static_cast<char>(i * 31 >> 3U);
    const auto back = echoed(message);
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back == message) << size;
  }
}

// The counter of beats lies after the longest part. Kills: a part that overwrites the counter.
TEST(Channel, CountsBeatsOfTheOtherEndBesideMessages) {
  const Ends ends = make_ends();
  EXPECT_EQ(ends.ours.beats(), 0U);
  ends.theirs.beat();
  ends.theirs.beat();
  std::thread other([&ends] { ends.theirs.send(std::string(Channel::memory_size(), '\xff'), {}); });
  EXPECT_TRUE(ends.ours.receive(kPlenty, {}));
  other.join();
  EXPECT_EQ(ends.ours.beats(), 2U);
}

TEST(Channel, TakesNoMoreThanItWants) {
  const Ends ends = make_ends();
  ASSERT_TRUE(ends.theirs.send("four", {}));
  EXPECT_FALSE(ends.ours.receive(3, {}));
  ASSERT_TRUE(ends.theirs.send("four", {}));
  EXPECT_EQ(ends.ours.receive(4, {}), "four");
}

TEST(Channel, EndsWhereTheOtherEndIsGone) {
  auto ends = std::make_unique<Ends>(make_ends());
  const Channel ours = std::move(ends->ours);
  ends.reset();
  EXPECT_FALSE(ours.receive(kPlenty, {}));
  EXPECT_FALSE(ours.send("anyone", {}));
}

TEST(Channel, EndsWhereWaitingDoes) {
  const Ends ends = make_ends();
  EXPECT_FALSE(ends.ours.receive(kPlenty, [] { return false; }));
}

/// The message that is read after the other end forged a header: the sizes of a part and of the
/// rest.
std::optional<std::string> forged(std::uint64_t size, std::uint64_t rest) {
  const Ends ends = make_ends();
  EXPECT_TRUE(ends.theirs.send("", {}));
  const std::array<std::uint64_t, 2> header{size, rest};
  void* const memory = ::mmap(nullptr, Channel::memory_size(), PROT_READ | PROT_WRITE, MAP_SHARED,
                              ends.theirs.memory(), 0);
  std::memcpy(memory, header.data(), sizeof header);
  ::munmap(memory, Channel::memory_size());
  return ends.ours.receive(kPlenty, {});
}

// Kills: a reader that copies as many bytes as the other end claims.
TEST(Channel, BelievesNoHeader) {
  EXPECT_EQ(forged(3, 0), std::string(3, '\0'));
  EXPECT_FALSE(forged(Channel::memory_size(), 0));
  EXPECT_FALSE(forged(~std::uint64_t{0}, 0));
  EXPECT_FALSE(forged(0, 1));
}

TEST(SharedMemory, IsRefusedWhereItIsTooSmall) {
  const Result<SharedMemory> small = SharedMemory::create(100);
  ASSERT_TRUE(small);
  EXPECT_FALSE(SharedMemory::open(cases::Descriptor(::dup(small->file())), 101));
}

}  // namespace
}  // namespace rastercheck::backends::channel_test
