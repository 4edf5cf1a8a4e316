#pragma once

#include <string_view>

namespace rastercheck::reports {

/// The styles that the page of a judged picture adds to those of report.html.
inline constexpr std::string_view kJudgedStyle = R"css(
.kinds { margin: .75rem 0 .5rem; max-width: 62rem; }
.kinds th, .kinds td { padding: .3rem .6rem; }
.kinds tr > :first-child { padding-left: 0; }
.next > div { margin-bottom: .5rem; }
#pictures .pictures { grid-template-columns: repeat(auto-fit, minmax(min(15rem, 100%), 1fr)); }
.kinds .swatch { margin-right: .5rem; vertical-align: -.15em; }
.channels { max-width: 62rem; overflow-wrap: anywhere; }
.whole { position: relative; }
.pictures figure { align-self: start; }
.pictures .whole img { max-height: 42rem; object-fit: contain; object-position: left top; }
.pictures .whole img.small { max-height: none; }
.whole svg.frames { position: absolute; inset: 0; width: 100%; max-width: none; height: 100%; }
.frames rect { fill: transparent; stroke: #fff; stroke-width: 1.2; vector-effect: non-scaling-stroke; filter: drop-shadow(0 0 1px #000); }
.frames a:hover rect { stroke: #ffd400; stroke-width: 3; }
[data-kind="part"] .picture .outline { filter: drop-shadow(0 0 1.2px var(--paper)) drop-shadow(0 0 1px var(--paper)); }
.of-key { white-space: nowrap; margin-right: .35rem; }
.of-key .swatch { margin-right: .25rem; vertical-align: -.2em; }
.panel .answer { border-top: 1px solid var(--line); padding-top: .3rem; }
.panel .wrong dd, .panel .wrong dt { color: var(--bad); }
.panel .faults { margin: .3rem 0; padding-left: 1.1rem; }
.panel .explain { font-size: .85rem; overflow-wrap: anywhere; }
.outcome .swatch { vertical-align: -.15em; }
@media (max-width: 44rem) {
  .kinds tr { grid-template-columns: 1fr auto auto; padding: .4rem 0; gap: .1rem .9rem; }
  .kinds tr > td { padding: 0; }
  .kinds td:first-child, .kinds td.number { grid-column: span 1; }
  .kinds td:last-child { color: var(--muted); }
}
)css";

}  // namespace rastercheck::reports
