#include "tests/cli/program.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <utility>

extern char** environ;

namespace rastercheck::cli {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Temporary files instead of pipes, so that nothing can block.
File temporary_file(const std::string& content = "") {
  File file(std::tmpfile());
  if (!file) throw std::runtime_error("no temporary file");
  std::fwrite(content.data(), 1, content.size(), file.get());
  std::fflush(file.get());
  std::rewind(file.get());
  return file;
}

std::string content_of(const File& file) {
  std::string text;
  std::rewind(file.get());
  for (int c = std::fgetc(file.get()); c != EOF; c = std::fgetc(file.get())) {
    text += static_cast<char>(c);
  }
  return text;
}

/// A process's standard input, output and error.
struct Standard {
  explicit Standard(const std::string& input) : in(temporary_file(input)) {}
  File in;
  File out = temporary_file();
  File err = temporary_file();
};

pid_t start(const char* program, const std::vector<std::string>& arguments,
            const Standard& standard) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(standard.in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(standard.out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(standard.err.get()), STDERR_FILENO);

  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  pid_t child = 0;
  const int spawned = posix_spawn(&child, program, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (spawned != 0) throw std::runtime_error("cannot start " + words.front());
  return child;
}

Outcome wait_for(pid_t child, const Standard& standard) {
  int status = 0;
  waitpid(child, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {code, content_of(standard.out), content_of(standard.err)};
}

Outcome run(const char* program, const std::vector<std::string>& arguments,
            const std::string& input) {
  const Standard standard(input);
  return wait_for(start(program, arguments, standard), standard);
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const std::string& input) {
  return run(RASTERCHECK_PROGRAM, arguments, input);
}

Outcome run_damaged_program(const std::vector<std::string>& arguments, const std::string& input) {
  return run(RASTERCHECK_DAMAGED_PROGRAM, arguments, input);
}

Outcome run_shell(const std::string& script) {
  return run(
      "/bin/sh",
      {"-c", "PROGRAM=" RASTERCHECK_PROGRAM " DAMAGED=" RASTERCHECK_DAMAGED_PROGRAM "\n" + script},
      "");
}

struct RunningProgram::Streams {
  Standard standard{""};
};

RunningProgram::RunningProgram(const std::vector<std::string>& arguments)
    : streams_(std::make_unique<Streams>()),
      process_(start(RASTERCHECK_DAMAGED_PROGRAM, arguments, streams_->standard)) {}

RunningProgram::~RunningProgram() {
  if (process_ == 0) return;
  kill(SIGKILL);
  wait();
}

void RunningProgram::kill(int signal) const { ::kill(process_, signal); }

Outcome RunningProgram::wait() { return wait_for(std::exchange(process_, 0), streams_->standard); }

bool is_failure(const Outcome& outcome, int code) {
  return outcome.code == code && outcome.out.empty() && outcome.err.starts_with("rastercheck: ") &&
         outcome.err.find('\n') == outcome.err.size() - 1;
}

std::ostream& operator<<(std::ostream& stream, const Outcome& outcome) {
  return stream << "exit code " << outcome.code << "\nstandard output:\n"
                << outcome.out << "standard error:\n"
                << outcome.err;
}

std::string square_case(const std::string& more_keys) {
  return R"({"format": "rastercheck-case", "version": 1, "name": "square",
    "framebuffer": {"width": 8, "height": 8}, "rules": "vulkan",
    "viewport": {"x": 0, "y": 0, "width": 8, "height": 8}, )" +
         more_keys + R"("attributes": [{"name": "x"}, {"name": "one"}],
    "vertices": [{"position": [-1, -1, 0.25, 1], "attributes": [0, 1]},
                 {"position": [1, -1, 0.25, 1], "attributes": [8, 1]},
                 {"position": [-1, 1, 0.25, 1], "attributes": [0, 1]},
                 {"position": [1, 1, 0.25, 1], "attributes": [8, 1]}],
    "triangles": [[0, 1, 2], [2, 1, 3]]})";
}

std::string without_environment(const std::string& run_json) {
  const std::size_t start = run_json.find("\n\"environment\": {");
  if (start == std::string::npos) return "no environment";
  return run_json.substr(0, start) + run_json.substr(run_json.find('\n', start + 1));
}

std::string source_file(const std::string& relative) {
  return std::string(RASTERCHECK_SOURCE_DIR) + "/" + relative;
}

}  // namespace rastercheck::cli
