// oracle/…: the judge, level by level, compared with the plain Gmpq path and with a check like that
// of a conformance suite, on the same fragments. Every benchmark reports fragments (or samples, or
// triangles) per second on one core, except those that name their number of threads.

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>

#include "backends/api_promise.h"
#include "backends/backend.h"
#include "backends/factory.h"
#include "cases/mesh.h"
#include "cases/mesh_reader.h"
#include "oracle/judge.h"
#include "oracle/referee.h"
#include "oracle/transform.h"
#include "oracle/ulp.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/mesh_scenes.h"

namespace rastercheck::bench {
namespace {

constexpr const char* kBunny = RASTERCHECK_BUNNY;

/// A scene with three attributes, on a target of that size.
cases::Case to_case(const Scene& scene, int width = kTarget, int height = kTarget) {
  cases::Case c;
  c.framebuffer = {width, height, 1};
  c.viewport.width = static_cast<float>(width);
  c.viewport.height = static_cast<float>(height);
  c.attributes = {{"u", {}, {}}, {"v", {}, {}}, {"t", {}, {}}};
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    const glm::vec4& p = scene.positions[i];
    c.positions.push_back({p.x, p.y, p.z, p.w});
    const float u = scene.attributes[2 * i];
    const float v = scene.attributes[2 * i + 1];
    c.attribute_values.insert(c.attribute_values.end(), {u, v, u - 3 * v});
  }
  for (const glm::uvec3& t : scene.triangles) c.triangles.push_back({t.x, t.y, t.z});
  return c;
}

/// The bunny, filling a target of 512 × 512.
cases::Case bunny() {
  const cases::Mesh mesh = cases::read_mesh(kBunny).value();
  const auto made = cases::case_of_mesh(mesh, kBunny, seen_from_the_front(mesh, {512, 512}));
  return oracle::to_clip_case(made->drawn, kBunny).value();
}

/// A case, and the fragments that a backend drew of it.
struct Drawn {
  cases::Case source;
  cases::Contract contract;
  cases::Fragments framebuffer;
};
using MakeCase = std::function<cases::Case()>;

Drawn draw(const MakeCase& make, const std::string& specification) {
  Drawn drawn;
  drawn.source = make();
  const auto backend = backends::make_backend(specification).value();
  drawn.contract = backend->contract(drawn.source);
  drawn.framebuffer = backend->draw(drawn.source).value().fragments;
  return drawn;
}

void set_rate(benchmark::State& bench, const char* what, double count) {
  bench.counters[what] = benchmark::Counter(count * static_cast<double>(bench.iterations()),
                                            benchmark::Counter::kIsRate);
}

void judge(benchmark::State& bench, const Drawn& drawn, const oracle::JudgeOptions& options) {
  for (auto _ : bench) {
    const oracle::SceneTruth truth(drawn.source, drawn.contract);
    benchmark::DoNotOptimize(oracle::judge(truth, drawn.framebuffer, options));
  }
  set_rate(bench, "fragments_per_second", static_cast<double>(drawn.framebuffer.size()));
}

void judge_drawing_of(benchmark::State& bench, const MakeCase& make,
                      const std::string& specification, const oracle::JudgeOptions& options) {
  judge(bench, draw(make, specification), options);
}

/// A figure of this process in KiB, as Linux reports it in /proc.
double process_figure(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != name + ":") continue;
    double kib = 0;
    status >> kib;
    return kib;
  }
  return 0;
}

/// Like judge(), but also reports the most memory that judging took at any time, without the case
/// and the framebuffer.
void judge_frame(benchmark::State& bench, const MakeCase& make,
                 const oracle::JudgeOptions& options) {
  const Drawn drawn = draw(make, "cpu");
  malloc_trim(0);
  // Makes Linux reset the peak.
  std::ofstream("/proc/self/clear_refs") << '5';
  const double before = process_figure("VmRSS");
  for (auto _ : bench) {
    const oracle::SceneTruth truth(drawn.source, drawn.contract);
    benchmark::DoNotOptimize(oracle::judge(truth, drawn.framebuffer, options));
  }
  bench.counters["peak_MiB"] = (process_figure("VmHWM") - before) / 1024;
  set_rate(bench, "fragments_per_second", static_cast<double>(drawn.framebuffer.size()));
}

/// The contract that OpenGL makes for a software driver. Mesa's llvmpipe has 8 subpixel bits,
/// SwiftShader 4.
cases::Contract api_contract(const cases::Case& source, int subpixel_bits) {
  backends::ApiLimits limits;
  limits.subpixel_bits = subpixel_bits;
  limits.is_software = true;
  return backends::api_promise(source, limits, limits.usual_promise());
}

/// Like judge(), but judges the drawing of `cpu` by the contract of an API.
void judge_by_api(benchmark::State& bench, const MakeCase& make, int subpixel_bits) {
  Drawn drawn = draw(make, "cpu");
  drawn.contract = api_contract(drawn.source, subpixel_bits);
  judge(bench, drawn, {});
}

/// Computes only the verdicts, of all samples in the triangles' bounding boxes.
void judge_coverage(benchmark::State& bench, const MakeCase& make, const std::string& specification,
                    oracle::Level first) {
  const Drawn drawn = draw(make, specification);
  oracle::JudgeOptions options;
  options.judges_values = false;
  options.first_level = first;
  double samples = 0;
  for (auto _ : bench) {
    const oracle::SceneTruth truth(drawn.source, drawn.contract);
    const auto levels = oracle::judge(truth, drawn.framebuffer, options).judgement.levels.samples;
    samples = static_cast<double>(levels.filter + levels.interval + levels.exact);
  }
  set_rate(bench, "samples_per_second", samples);
}

/// The plain path: in Gmpq, each triangle's q-matrix and each fragment's coverage, values and
/// errors.
void judge_by_gmpq(benchmark::State& bench, const MakeCase& make) {
  const Drawn drawn = draw(make, "cpu");
  const cases::Fragments& f = drawn.framebuffer;
  const std::size_t attributes = drawn.source.attributes.size();
  const oracle::Rational one(1);
  std::vector<oracle::Rational> magnitudes;
  double worst = 0;
  for (auto _ : bench) {
    for (std::size_t i = 0; i < f.size();) {
      const std::uint32_t t = f.triangle[i];
      const oracle::Referee referee(drawn.source, t);
      for (; i < f.size() && f.triangle[i] == t; ++i) {
        const auto exact = referee.at(f.x[i], f.y[i], f.sample[i]);
        if (!exact) return bench.SkipWithError("an uncovered sample was drawn");
        worst = std::max(worst, oracle::scale_ulp_error(f.depth[i], exact->depth, one).hi);
        for (std::size_t a = 0; a < attributes; ++a) {
          worst = std::max(
              worst, oracle::scale_ulp_error(f.attributes_of(i)[a], *exact->attributes[a], one).hi);
        }
      }
    }
    benchmark::DoNotOptimize(worst);
  }
  set_rate(bench, "fragments_per_second", static_cast<double>(f.size()));
}

/// A check like that of conformance suites: barycentric weights in double, and differences compared
/// with a tolerance.
class Float64Check {
 public:
  explicit Float64Check(const Drawn& drawn) : drawn_(&drawn) {}

  std::size_t failures() const {
    const cases::Fragments& f = drawn_->framebuffer;
    std::size_t failures = 0;
    for (std::size_t i = 0; i < f.size();) {
      const std::uint32_t t = f.triangle[i];
      const Plane plane(drawn_->source, t);
      for (; i < f.size() && f.triangle[i] == t; ++i) failures += check(plane, i) ? 0U : 1U;
    }
    return failures;
  }

 private:
  struct Plane {
    Plane(const cases::Case& c, std::uint32_t triangle) : indices(c.triangles[triangle]) {
      for (std::size_t i = 0; i < 3; ++i) {
        const cases::ClipVertex& p = c.positions[indices[i]];
        w[i] = p.w;
        z[i] = p.z;
        x[i] = (double{p.x} / p.w + 1) * c.viewport.width / 2 + c.viewport.x;
        y[i] = (double{p.y} / p.w + 1) * c.viewport.height / 2 + c.viewport.y;
      }
      area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    }
    cases::Triangle indices;
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    std::array<double, 3> z{};
    std::array<double, 3> w{};
    double area = 0;
  };

  bool check(const Plane& p, std::size_t i) const {
    const cases::Fragments& f = drawn_->framebuffer;
    const double u = f.x[i] + 0.5;
    const double v = f.y[i] + 0.5;
    std::array<double, 3> b{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3;
      const std::size_t n = (k + 2) % 3;
      b[k] = ((p.x[n] - p.x[m]) * (v - p.y[m]) - (p.y[n] - p.y[m]) * (u - p.x[m])) / p.area;
    }
    if (b[0] < -kTolerance || b[1] < -kTolerance || b[2] < -kTolerance) return false;
    const double depth = b[0] * p.z[0] / p.w[0] + b[1] * p.z[1] / p.w[1] + b[2] * p.z[2] / p.w[2];
    bool is_right = std::abs(f.depth[i] - depth) <= kTolerance;
    const double inverse_w = b[0] / p.w[0] + b[1] / p.w[1] + b[2] / p.w[2];
    for (std::size_t a = 0; a < drawn_->source.attributes.size(); ++a) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += b[k] / p.w[k] * drawn_->source.attributes_of(p.indices[k])[a];
      }
      is_right = is_right && std::abs(f.attributes_of(i)[a] - sum / inverse_w) <= kTolerance;
    }
    return is_right;
  }

  /// The tolerance of suites is up to 0.0064 (Khronos). Here, values are around 1.
  static constexpr double kTolerance = 1e-5;

  const Drawn* drawn_;
};

void check_in_float64(benchmark::State& bench, const MakeCase& make) {
  const Drawn drawn = draw(make, "cpu");
  const Float64Check check(drawn);
  for (auto _ : bench) benchmark::DoNotOptimize(check.failures());
  set_rate(bench, "fragments_per_second", static_cast<double>(drawn.framebuffer.size()));
}

/// Only the exact set-up, with the bounding box of every triangle.
void set_up(benchmark::State& bench, const MakeCase& make) {
  const Drawn drawn = draw(make, "cpu");
  const oracle::SceneTruth truth(drawn.source, drawn.contract);
  for (auto _ : bench) {
    for (std::size_t t = 0; t < drawn.source.triangles.size(); ++t) {
      benchmark::DoNotOptimize(oracle::TriangleTruth(truth, t).pixels());
    }
  }
  set_rate(bench, "triangles_per_second", static_cast<double>(drawn.source.triangles.size()));
}

template <typename... Rest>
void add(const std::string& name, void (*run)(benchmark::State&, const MakeCase&, Rest...),
         const MakeCase& make, const std::type_identity_t<std::decay_t<Rest>>&... rest) {
  benchmark::RegisterBenchmark(("oracle/" + name).c_str(),
                               [=](benchmark::State& bench) { run(bench, make, rest...); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

MakeCase random_case(int count, float side) {
  return [=] { return to_case(random_triangles(count, side)); };
}

oracle::JudgeOptions from(oracle::Level first, unsigned jobs = 1) {
  oracle::JudgeOptions options;
  options.first_level = first;
  options.jobs = jobs;
  return options;
}

/// Makes the same case with four samples per pixel, and with attributes at centroids.
MakeCase centroids(int count, float side) {
  return [=] {
    cases::Case c = to_case(random_triangles(count, side));
    c.framebuffer.samples = 4;
    for (cases::Attribute& a : c.attributes) a.location = cases::Location::centroid;
    return c;
  };
}

/// A whole frame: 1920 × 1080, 100,000 triangles, four attributes.
cases::Case frame(cases::DepthTest depth_test) {
  cases::Case c = to_case(random_triangles(100'000, 8), 1920, 1080);
  c.depth_test = depth_test;
  c.attributes.push_back({"n", cases::Interpolation::noperspective, {}});
  std::vector<float> values;
  for (std::size_t vertex = 0; vertex < c.positions.size(); ++vertex) {
    for (std::size_t a = 0; a < 3; ++a) values.push_back(c.attribute_values[3 * vertex + a]);
    values.push_back(values.back() + 1);
  }
  c.attribute_values = std::move(values);
  return c;
}

const bool kRegistered = [] {
  using oracle::Level;
  const MakeCase large = random_case(40, 160);
  const MakeCase grid = [] { return to_case(grid_triangles(2000, 8)); };
  // Slow levels draw less. The fast levels also judge the smaller case, for comparison.
  const MakeCase small = random_case(10, 72);
  for (const auto& [suffix, make] : {std::pair{"", large}, std::pair{"_72px", small}}) {
    const std::string end(suffix);
    add("coverage/filter" + end, judge_coverage, make, "cpu", Level::filter);
    add("coverage/interval" + end, judge_coverage, make, "cpu", Level::interval);
    add("errors/filter" + end, judge_drawing_of, make, "cpu", from(Level::filter));
    add("errors/interval" + end, judge_drawing_of, make, "cpu", from(Level::interval));
    add("errors/float64" + end, check_in_float64, make);
    add("errors/placements" + end, judge_drawing_of, make, "method:rational-linear",
        from(Level::filter));
    add("errors/api" + end, judge_by_api, make, 8);
  }
  add("coverage/exact_72px", judge_coverage, small, "cpu", Level::exact);
  add("errors/exact_72px", judge_drawing_of, small, "cpu", from(Level::exact));
  add("errors/gmpq_72px", judge_by_gmpq, small);
  add("errors/grid_8px", judge_drawing_of, grid, "cpu", from(Level::filter));
  add("coverage/placements_72px", judge_coverage, small, "method:rational-linear", Level::filter);
  add("errors/api_bunny", judge_by_api, bunny, 8);
  add("errors/api_bunny_4bits", judge_by_api, bunny, 4);
  add("errors/centroids_72px", judge_drawing_of, centroids(10, 72), "cpu", from(Level::filter));
  add("errors/api_centroids_72px", judge_by_api, centroids(10, 72), 8);
  add("setup", set_up, random_case(5000, 8));
  // Shows how time grows with area and with count: the same triangles four times as large, and four
  // times as many.
  add("linear/triangles:2000/fragments:64000", judge_drawing_of, random_case(2000, 8), "cpu",
      from(Level::filter));
  add("linear/triangles:2000/fragments:256000", judge_drawing_of, random_case(2000, 16), "cpu",
      from(Level::filter));
  add("linear/triangles:2000/fragments:1024000", judge_drawing_of, random_case(2000, 32), "cpu",
      from(Level::filter));
  add("linear/triangles:8000/fragments:256000", judge_drawing_of, random_case(8000, 8), "cpu",
      from(Level::filter));
  add("linear/triangles:32000/fragments:1024000", judge_drawing_of, random_case(32000, 8), "cpu",
      from(Level::filter));
  add("bunny/threads:1", judge_drawing_of, bunny, "cpu", from(Level::filter, 1));
  add("bunny/threads:2", judge_drawing_of, bunny, "cpu", from(Level::filter, 2));
  const auto all = [] { return frame(cases::DepthTest::none); };
  const auto nearest = [] { return frame(cases::DepthTest::less); };
  for (const unsigned threads : {1U, 2U}) {
    const std::string suffix = "/threads:" + std::to_string(threads);
    add("frame/all" + suffix, judge_frame, all, from(Level::filter, threads));
    add("frame/nearest" + suffix, judge_frame, nearest, from(Level::filter, threads));
  }
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
