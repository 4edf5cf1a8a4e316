#pragma once

// What report.html is brought to life with, as the build puts it here: reports/viewer/ and d3.

#include <string>
#include <string_view>

namespace rastercheck::reports {

/// Style sheets of the page and the viewer.
extern const std::string_view kViewerStyle;

/// The page's scripts, at its end: d3 and the modules of reports/viewer/ as one.
std::string viewer_scripts();

/// What a browser is told to run and to load: these scripts, pictures within the page, nothing
/// else from anywhere. The content of a Content-Security-Policy.
std::string viewer_policy();

}  // namespace rastercheck::reports
