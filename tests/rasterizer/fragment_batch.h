#pragma once

// A batch of fragments whose attributes are known exactly.

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "rasterizer/shading.h"
#include "tests/rasterizer/exact.h"

namespace rastercheck::rasterizer {

inline mpz_class floor_of(const Rational& x) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return result;
}

/// A batch with all cells, all lanes covered, and attributes that start as exact zeros.
class KnownBatch : public ExactAttributes {
 public:
  static constexpr std::size_t kLanes = FragmentBatch::kLanes;
  using Lanes = std::array<double, kLanes>;
  struct Call {
    std::size_t attribute;
    std::size_t lane;
    double scale;
    bool operator==(const Call&) const = default;
  };

  explicit KnownBatch(std::size_t attributes) : lines(attributes), errors(attributes) {
    exact.resize(attributes, std::vector<Rational>(kLanes));
    for (FragmentBatch::Cell& cell : cells) cell.covered = 0xffff;
  }

  /// Sets the attribute to a number, which double holds exactly.
  void set(std::size_t attribute, std::size_t lane, double value) {
    lines[attribute].value[lane] = value;
    exact[attribute][lane] = std::isfinite(value) ? Rational(value) : 0;
  }
  void set_slopes(std::size_t attribute, double along_u, double along_v) {
    lines[attribute].along_u.fill(along_u);
    lines[attribute].along_v.fill(along_v);
  }

  double floor(std::size_t attribute, std::size_t lane, double scale, double period) override {
    calls.push_back({attribute, lane, scale});
    const mpz_class index = floor_of(exact[attribute][lane] * Rational(scale));
    if (std::isinf(period)) return index.get_d();
    const mpz_class whole(period);
    return mpz_class(index % whole).get_d();
  }

  bool is_front(std::size_t /*lane*/) override { return true; }
  float depth(std::size_t /*lane*/) override { return 0; }
  double reciprocal_w(std::size_t /*lane*/) override { return 1; }

  /// The batch, valid until this object changes.
  FragmentBatch batch() {
    values_.clear();
    along_u_.clear();
    along_v_.clear();
    for (const Line& line : lines) {
      values_.push_back(line.value.data());
      along_u_.push_back(line.along_u.data());
      along_v_.push_back(line.along_v.data());
    }
    FragmentBatch batch;
    batch.lanes = cells.size() * FragmentBatch::kCellLanes;
    batch.cells = cells;
    batch.values = values_;
    batch.along_u = along_u_;
    batch.along_v = along_v_;
    batch.errors = errors;
    batch.exact = this;
    return batch;
  }

  struct Line {
    alignas(64) Lanes value{};
    alignas(64) Lanes along_u{};
    alignas(64) Lanes along_v{};
  };
  std::vector<Line> lines;
  std::vector<double> errors;
  std::vector<std::vector<Rational>> exact;  ///< [attribute][lane]
  std::vector<FragmentBatch::Cell> cells = std::vector<FragmentBatch::Cell>(FragmentBatch::kCells);
  std::vector<Call> calls;

 private:
  std::vector<const double*> values_;
  std::vector<const double*> along_u_;
  std::vector<const double*> along_v_;
};

/// The buffers that a shader fills in.
class ShadedLanes {
 public:
  explicit ShadedLanes(std::size_t outputs = 4) : lines_(outputs) {
    for (Line& line : lines_) {
      line.color.fill(-1);
      color_.push_back(line.color.data());
    }
  }
  ShadedLanes(const ShadedLanes&) = delete;
  ShadedLanes& operator=(const ShadedLanes&) = delete;

  std::span<float* const, 4> colors() const { return std::span(color_).first<4>(); }
  ShadedBatch batch() { return {color_, discarded}; }
  float operator()(std::size_t output, std::size_t lane) const {
    return lines_[output].color[lane];
  }

  std::array<std::uint16_t, FragmentBatch::kCells> discarded{};

 private:
  struct Line {
    alignas(64) std::array<float, FragmentBatch::kLanes> color{};
  };
  std::vector<Line> lines_;
  std::vector<float*> color_;
};

}  // namespace rastercheck::rasterizer
