#include "backends/isolation.h"

#include <fmt/format.h>

#include <optional>
#include <span>
#include <utility>

#include "backends/api_promise.h"
#include "backends/internal/worker_process.h"

namespace rastercheck::backends {
namespace {

/// The backend is given up after this many crashes in a row, or this many hangs in total, since
/// each hang takes time.
constexpr int kMostCrashes = 20;
constexpr int kMostHangs = 10;

/// True if a contract has no per-triangle promises or as many as the case has triangles.
bool fits(const cases::Contract& contract, const cases::Case& c) {
  return contract.triangles.empty() || contract.triangles.size() == c.triangles.size();
}

/// Stands in for a backend in another process.
class IsolatedBackend : public Backend,
                        public PictureDrawer,
                        public WaysOfDrawing,
                        public Assembler,
                        public OcclusionCuller {
 public:
  IsolatedBackend(std::string specification, const Isolation& isolation, WorkerProcess process)
      : specification_(std::move(specification)),
        isolation_(isolation),
        greeting_(process.greeting()),
        process_(std::move(process)) {}

  About about() const override { return greeting_.about; }

  WaysOfDrawing* ways_of_drawing() override { return ways().empty() ? nullptr : this; }
  std::vector<cases::DrawBy> ways() const override { return greeting_.about.ways; }
  Result<cases::Fragments> draw_by(const cases::Case& c, cases::DrawBy way) override {
    return draw_in(c, way);
  }

  PictureDrawer* picture_drawer() override {
    return greeting_.about.draws_pictures ? this : nullptr;
  }
  Result<cases::Picture> draw_picture(const cases::Case& c,
                                      const cases::Pipeline& pipeline) override {
    const Result<std::string> answer =
        ask_once_promised({.question = Question::picture, .source = c, .pipeline = pipeline});
    if (!answer) return tl::unexpected(answer.error());
    std::optional<PictureAnswer> drawn = unpack_picture(*answer);
    if (!drawn) return tl::unexpected(nonsense());
    if (drawn->problem) return tl::unexpected(counted(*drawn->problem));
    crashes_ = 0;
    return std::move(drawn->picture);
  }

  Assembler* assembler() override { return greeting_.about.assembles ? this : nullptr; }
  Result<cases::Fragments> draw_assembled(const cases::Case& c, cases::Topology topology,
                                          std::span<const std::uint32_t> indices) override {
    const Result<std::string> answer =
        ask_once_promised({.question = Question::assembly,
                           .source = c,
                           .topology = topology,
                           .indices = {indices.begin(), indices.end()}});
    if (!answer) return tl::unexpected(answer.error());
    std::optional<DrawingAnswer> drawing = unpack_drawing(*answer);
    if (!drawing) return tl::unexpected(nonsense());
    if (drawing->problem) return tl::unexpected(counted(*drawing->problem));
    crashes_ = 0;
    return std::move(drawing->drawn.fragments);
  }

  OcclusionCuller* occlusion_culler() override {
    return greeting_.about.answers_occlusion_queries ? this : nullptr;
  }
  Result<bool> is_occluded(const cases::Case& c, std::size_t occluders) override {
    const Result<std::string> answer = ask_once_promised({Question::occlusion, c, {}, occluders});
    if (!answer) return tl::unexpected(answer.error());
    const std::optional<OcclusionAnswer> said = unpack_occlusion(*answer);
    if (!said) return tl::unexpected(nonsense());
    if (said->problem) return tl::unexpected(counted(*said->problem));
    crashes_ = 0;
    return said->is_occluded;
  }

  std::optional<Error> is_lost() const override {
    if (crashes_ < kMostCrashes && hangs_ < kMostHangs) return std::nullopt;
    Error error = *last_loss_;
    error.reason = fmt::format("not drawn after {} crashes in a row and {} hangs; the last one: {}",
                               crashes_, hangs_, error.reason);
    return error;
  }

  cases::Contract promise(const cases::Case& c) const override {
    if (const auto& api = greeting_.about.api) return promise_of(*api, c);
    if (remembered_ && remembered_->first == c) return remembered_->second;
    if (!c.triangles.empty()) return asked_for_promise(c);
    // Before each case, laws ask for the promise of the same case without triangles.
    if (of_nothing_ && of_nothing_->first == c) return of_nothing_->second;
    const cases::Contract said = asked_for_promise(c);
    if (!withheld_) of_nothing_ = {c, said};
    return said;
  }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    return draw_in(c, std::nullopt);
  }

  Result<cases::Fragments> draw_in(const cases::Case& c, std::optional<cases::DrawBy> way) {
    const Result<std::string> answer = ask_once_promised({Question::drawing, c, way});
    if (!answer) return tl::unexpected(answer.error());
    std::optional<DrawingAnswer> drawing = unpack_drawing(*answer);
    if (!drawing || (!drawing->problem && !fits(drawing->drawn.contract, c))) {
      return tl::unexpected(nonsense());
    }
    if (drawing->problem) return tl::unexpected(counted(*drawing->problem));
    crashes_ = 0;
    if (greeting_.about.api) return std::move(drawing->drawn.fragments);
    if (!remembered_ || remembered_->first != c) remembered_ = {c, drawing->drawn.contract};
    return std::move(drawing->drawn.fragments);
  }

  /// Returns the promise of the driver's API, cached for the next question about the same case.
  cases::Contract promise_of(const ApiLimits& api, const cases::Case& c) const {
    const cases::DriverPromise promised = *driver_promise();
    if (remembered_ && promised_ == promised && remembered_->first == c) return remembered_->second;
    remembered_ = {c, api_promise(c, api, promised)};
    promised_ = promised;
    return remembered_->second;
  }

  cases::Contract asked_for_promise(const cases::Case& c) const {
    withheld_.reset();
    std::optional<cases::Contract> said;
    // Tries twice: if the process had already ended, its failure says nothing about this case.
    for (int i = 0; i < 2 && !said; ++i) {
      const Result<std::string> answer = ask({Question::promise, c});
      if (answer) said = unpack_contract(*answer);
      if (said && !fits(*said, c)) said.reset();
      if (!said) withheld_ = {c, answer ? nonsense() : answer.error()};
    }
    if (!said) return cases::contract_of(c);  // drawing the case will report the error
    withheld_.reset();
    remembered_ = {c, *said};
    return *said;
  }

  /// Like ask(), but fails at once if asking for the promise of the same case has just failed.
  Result<std::string> ask_once_promised(const Request& request) const {
    if (const auto withheld = std::exchange(withheld_, std::nullopt);
        withheld && withheld->first == request.source) {
      return tl::unexpected(withheld->second);
    }
    return ask(request);
  }

  /// Returns the process's answer. Starts a new process if the last one has ended.
  Result<std::string> ask(const Request& request) const {
    if (!process_) {
      Result<WorkerProcess> started = WorkerProcess::start(specification_, isolation_);
      if (!started) return tl::unexpected(lose(started.error()));
      process_.emplace(*std::move(started));
    }
    Result<std::string> answer = process_->ask(request);
    if (!answer) return tl::unexpected(lose(answer.error()));
    return answer;
  }

  /// If the process reports that a program it started has crashed, counts that crash and adds the
  /// program's last words to the error. Any other failure is returned unchanged, and the count of
  /// crashes in a row starts again.
  Error counted(Error why) {
    if (why.failure != Failure::crash) {
      crashes_ = 0;
      return why;
    }
    ++crashes_;
    last_loss_ = process_->with_last_words(std::move(why));
    return *last_loss_;
  }

  Error nonsense() const { return lose(process_->end_for_nonsense()); }

  Error lose(Error why) const {
    process_.reset();
    if (why.failure != Failure::hang) why.failure = Failure::crash;
    ++(why.failure == Failure::hang ? hangs_ : crashes_);
    last_loss_ = why;
    return why;
  }

  std::string specification_;
  Isolation isolation_;
  Greeting greeting_;
  // Mutable, because even asking for a contract may end the process.
  mutable std::optional<WorkerProcess> process_;
  mutable int crashes_ = 0;  ///< since the last drawing that was returned
  mutable int hangs_ = 0;    ///< since construction
  mutable std::optional<Error> last_loss_;
  mutable std::optional<std::pair<cases::Case, Error>> withheld_;
  mutable std::optional<std::pair<cases::Case, cases::Contract>> remembered_;
  mutable std::optional<cases::DriverPromise> promised_;  ///< the promise behind `remembered_`
  mutable std::optional<std::pair<cases::Case, cases::Contract>> of_nothing_;
};

}  // namespace

Result<std::unique_ptr<Backend>> make_isolated_backend(const std::string& specification,
                                                       const Isolation& isolation) {
  Result<WorkerProcess> process = WorkerProcess::start(specification, isolation);
  if (!process) return tl::unexpected(process.error());
  return std::make_unique<IsolatedBackend>(specification, isolation, *std::move(process));
}

MakeBackend isolated_by(const Isolation& isolation) {
  return [isolation](const std::string& specification) {
    return make_isolated_backend(specification, isolation);
  };
}

}  // namespace rastercheck::backends
