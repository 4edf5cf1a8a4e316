// The backend `exec:COMMAND`, any program that draws (docs/exec-protocol.md).

#include <fmt/format.h>
#include <wordexp.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "backends/exec/program.h"
#include "backends/factory.h"

namespace rastercheck::backends::exec_registration {
namespace {

constexpr std::string_view kNoSandbox = "--no-sandbox";

Error error_of(const std::string& options, Error error) {
  if (!error.file.empty()) error.reason = error.file + ": " + error.reason;
  error.file = "exec:" + options;
  return error;
}

/// The words of a command as a shell would make them, without running anything.
Result<std::vector<std::string>> words_of(const std::string& options) {
  wordexp_t expanded{};
  const int problem = ::wordexp(options.c_str(), &expanded, WRDE_NOCMD);
  const std::unique_ptr<wordexp_t, decltype(&::wordfree)> owner(&expanded, &::wordfree);
  if (problem == 0) {
    return std::vector<std::string>(expanded.we_wordv, expanded.we_wordv + expanded.we_wordc);
  }
  std::string reason = "cannot be split into words";
  if (problem == WRDE_BADCHAR) {
    reason =
        "needs quotes around one of | & ; < > ( ) { } or an end of line; nothing is run by a "
        "shell";
  } else if (problem == WRDE_SYNTAX) {
    reason = "has a quote that does not end";
  } else if (problem == WRDE_CMDSUB) {
    reason = "has a command within it, which is not run";
  }
  return tl::unexpected(Error{"exec:" + options, "", reason});
}

class ExecBackend : public Backend {
 public:
  ExecBackend(std::string options, std::vector<std::string> command, bool is_confined,
              Program program)
      : options_(std::move(options)),
        command_(std::move(command)),
        is_confined_(is_confined),
        hello_(program.hello()),
        program_(std::make_unique<Program>(std::move(program))) {}

  About about() const override {
    std::string description = hello_.name;
    if (!hello_.version.empty()) description += " " + hello_.version;
    if (hello_.gives == Gives::triangle) description += "; gives no depth and no attributes";
    if (hello_.gives == Gives::depth) description += "; gives no attributes";
    if (hello_.gives == Gives::barycentrics) description += "; gives barycentrics";
    if (!is_confined_) description += "; runs without a sandbox";
    return {.description = description, .has_limits = true, .capabilities = hello_.limits};
  }
  cases::Contract promise(const cases::Case& c) const override { return contract_of(hello_, c); }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    if (const std::string what = cases::lacked_by(hello_.limits, c); !what.empty()) {
      return tl::unexpected(
          Error{"exec:" + options_, "", "its limits exclude " + what, Failure::unsupported});
    }
    Result<cases::Fragments> drawn = draw_all(c);
    if (drawn) return drawn;
    // Nobody knows where the next answer of a program that went wrong begins.
    if (drawn.error().failure == Failure::crash) program_.reset();
    return tl::unexpected(error_of(options_, drawn.error()));
  }

  Result<cases::Fragments> draw_all(const cases::Case& c) {
    if (!program_) {
      Result<Program> started = Program::start(command_);
      if (!started) return tl::unexpected(started.error());
      program_ = std::make_unique<Program>(*std::move(started));
    }
    cases::FragmentCollector fragments(c);
    const auto triangles = static_cast<std::uint32_t>(c.triangles.size());
    const bool is_together = c.depth_test != cases::DepthTest::none;
    const cases::Contract promised = promise(c);
    for (std::uint32_t i = 0; i < (is_together ? std::min(triangles, 1U) : triangles); ++i) {
      const std::optional<std::uint32_t> alone =
          is_together ? std::nullopt : std::optional<std::uint32_t>(i);
      if (Result<void> added = add(c, promised, alone, fragments); !added) {
        return tl::unexpected(added.error());
      }
      go_on();
    }
    return fragments.take().map_error([](const std::string& fault) {
      return Error{"", "", "its answers: " + fault};
    });
  }

  Result<void> add(const cases::Case& c, const cases::Contract& promised,
                   std::optional<std::uint32_t> alone, cases::FragmentCollector& fragments) {
    const Result<Program::Answer> answer = program_->draw(draw_message(c, promised, alone), c);
    if (!answer) return tl::unexpected(answer.error());
    const AnswerHeader& header = answer->header;
    if (header.status != AnswerHeader::Status::ok) {
      const bool is_failed = header.status == AnswerHeader::Status::failed;
      return tl::unexpected(
          Error{"", "",
                fmt::format("it answered {}: {}", cases::name_of(header.status),
                            header.message.empty() ? "(no message)" : header.message),
                is_failed ? Failure::refused : Failure::unsupported});
    }
    std::string fault = add_answer(header, answer->arrays, hello_.gives, c, alone, fragments);
    if (fault.empty()) return {};
    return tl::unexpected(Error{"", "", std::move(fault)});
  }

  std::string options_;
  std::vector<std::string> command_;
  bool is_confined_;
  ProgramHello hello_;
  std::unique_ptr<Program> program_;  ///< empty after a failure, until the next drawing
};

ProcessRights rights(const std::string& options) {
  return {.is_confined = !options.starts_with(kNoSandbox), .may_reserve_memory = true};
}

Result<std::unique_ptr<Backend>> make(const std::string& options) {
  Result<std::vector<std::string>> command = words_of(options);
  if (!command) return tl::unexpected(command.error());
  const bool is_confined = rights(options).is_confined;
  if (!is_confined) command->erase(command->begin());
  if (command->empty()) {
    return tl::unexpected(Error{"exec:" + options, "", "names no command"});
  }
  Result<Program> program = Program::start(*command);
  if (!program) {
    Error error = error_of(options, program.error());
    error.failure = Failure::unavailable;
    return tl::unexpected(error);
  }
  return std::make_unique<ExecBackend>(options, *std::move(command), is_confined,
                                       *std::move(program));
}

std::vector<Listing> list() {
  return {{"exec:COMMAND", "your program, in any language (docs/exec-protocol.md)",
           "COMMAND must start the program"}};
}

const BackendRegistration kRegistration({"exec", &make, &list, true, &rights});

}  // namespace
}  // namespace rastercheck::backends::exec_registration
