#pragma once

// Pipelines that laws about pictures draw cases with.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "cases/picture.h"

namespace rastercheck::properties {

/// A pipeline without a texture, chosen by the case's numbers alone: depth function and write mask,
/// what depths are cleared to, blend, format, resolve, and whether attributes are channels or
/// vertex colours.
cases::Pipeline pipeline_of(const cases::Case& c);

/// The pipeline in words, for notes.
std::string text_of(const cases::Pipeline& pipeline);

std::string_view word_of(cases::DepthFunction function);
std::string_view word_of(cases::Blend blend);

}  // namespace rastercheck::properties
