#pragma once

// The scripts and styles of report.html's viewer, which the build embeds: reports/viewer/ and d3.

#include <string>
#include <string_view>

namespace rastercheck::reports {

/// The style sheets of the page and of the viewer.
extern const std::string_view kViewerStyle;

/// The scripts at the end of the page: d3, and the modules of reports/viewer/ joined into one.
std::string viewer_scripts();

/// The content of a Content-Security-Policy. It lets a browser run and load only these scripts, and
/// pictures within the page; nothing from anywhere else.
std::string viewer_policy();

}  // namespace rastercheck::reports
