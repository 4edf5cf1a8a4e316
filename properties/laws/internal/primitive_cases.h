#pragma once

// Shared by laws about lines and points.

#include <functional>
#include <string_view>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/contract.h"
#include "cases/sample_place.h"
#include "properties/draw.h"
#include "properties/law.h"
#include "properties/window_position.h"

namespace rastercheck::properties {

/// True if the backend draws lines, or points (Law::is_promised).
bool draws_lines(backends::Backend& backend);
bool draws_points(backends::Backend& backend);

// Law::unpromised.
inline constexpr std::string_view kDrawsNoLines = "the backend draws no lines";
inline constexpr std::string_view kDrawsNoPoints = "the backend draws no points";
// Check::why_not.
inline constexpr std::string_view kNotLines = "the property is about lines";
inline constexpr std::string_view kNotPoints = "the property is about points";

/// Cases of the generators “lines” and “points”. The stratum of lines is their mode.
Generated random_lines(Draw& draw);
Generated random_points(Draw& draw);

/// Makes the lines of a case rectangles or parallelograms.
void set_area_mode(Draw& draw, cases::Case& c);

/// Makes the framebuffer 16 or 32 pixels wide and high, and the viewport all of it: window
/// positions with few bits are then exact in clip space.
void set_square_viewport(Draw& draw, cases::Case& c);

/// Makes flat attributes smooth: another vertex would provoke their values.
void leave_out_flat_attributes(cases::Case& c);

/// Moves attributes at centroids to pixels' centres: a centroid depends on which samples of its
/// pixel are covered.
void leave_out_centroids(cases::Case& c);

/// True if nothing cuts or drops a primitive with these vertices: all have w > 0 and lie strictly
/// inside the viewport's sides, the depth planes and the clip distances.
bool is_inside(const cases::Case& c, const cases::Triangle& vertices);

/// True if both coordinates are multiples of an eighth of a pixel.
bool is_on_eighths(const WindowPoint& p);
/// The greatest multiple of an eighth that is not above `at`.
double floor_to_eighths(double at);
/// True if a contract leaves vertices where they are if they are on such places, and names a fill
/// rule by which every edge's samples have one owner.
bool keeps_eighths(const cases::Contract& contract);

/// Visits the samples of the framebuffer inside the scissor, with their window positions and
/// triangle 0.
void for_each_sample(
    const cases::Case& c, const cases::Contract& contract,
    const std::function<void(const cases::SamplePlace&, const WindowPoint&)>& visit);

}  // namespace rastercheck::properties
