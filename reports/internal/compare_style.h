#pragma once

#include <string_view>

namespace rastercheck::reports {

/// The styles that compare.html adds to those of report.html: for overlaid distributions, and for
/// pictures whose pixels are visible.
inline constexpr std::string_view kCompareStyle = R"css(
.worse { font-size: .88rem; }
.worse th, .worse td { padding: .3rem .5rem; }
.worse tr > :first-child { padding-left: 0; }
.worse td:first-child { min-width: 14rem; }
.worse td:last-child > span { white-space: nowrap; }
svg.crop + figcaption { padding: .3rem 0; }
.worse + details > summary, .overlay summary { color: var(--accent); padding: .3rem 0; }
.entry { display: grid; gap: .5rem 2rem; grid-template-columns: repeat(auto-fit, minmax(min(24rem, 100%), 1fr)); }
.entry > * { min-width: 0; }
.entry table, .worst-of, .pixels { font-size: .86rem; }
.entry th, .entry td, .pixels td, .pixels th, .worst-of td, .worst-of th { padding: .25rem .5rem; }
.entry tr > :first-child, .pixels tr > :first-child, .worst-of tr > :first-child { padding-left: 0; }
.entry th, .pixels th, .worst-of th { white-space: normal; }
.largest { background: var(--mark); }
.overlay svg { max-width: 40rem; }
svg rect.after { fill: var(--accent); opacity: .55; }
svg rect.before { fill: none; stroke: var(--ink); stroke-width: 1.4; pointer-events: all; }
.swatch {
  display: inline-block; width: 1em; height: 1em; border: 1px solid var(--line); text-align: center;
  line-height: .9em; vertical-align: -.1em; background: var(--undrawn);
}
.swatch.after { background: var(--accent); opacity: .55; }
.swatch.before { background: none; border: 1.5px solid var(--ink); }
.swatch.same { background: var(--same); }
.swatch.odd { background: var(--odd); color: #fff; }
.swatch.looked { border: 2px solid var(--above); }
:root { --undrawn: #f2f2ee; --same: #cfd3d6; }
@media (prefers-color-scheme: dark) { :root { --undrawn: #24292e; --same: #4b5359; } }
.crops { display: grid; gap: 1rem 1.25rem; grid-template-columns: repeat(auto-fit, minmax(min(17rem, 100%), 1fr)); max-width: 62rem; margin: .75rem 0; align-items: start; }
svg.crop { width: 100%; max-width: 24rem; background: var(--undrawn); border: 1px solid var(--line); shape-rendering: crispEdges; }
svg.crop .same { fill: var(--same); }
svg.crop .odd { fill: var(--odd); }
svg.crop .cross { fill: none; stroke: #fff; stroke-width: .16; pointer-events: none; }
svg.crop polygon { fill: none; stroke: var(--ink); stroke-width: 1; vector-effect: non-scaling-stroke; pointer-events: none; shape-rendering: auto; }
svg.crop .focus { fill: none; stroke: var(--above); stroke-width: 3; vector-effect: non-scaling-stroke; pointer-events: none; }
svg.legend { max-width: 22rem; }
.key-of-crops { display: grid; gap: .25rem 2rem; grid-template-columns: minmax(16rem, 22rem) 1fr; align-items: start; font-size: .88rem; color: var(--muted); max-width: 62rem; }
.missing { padding: .6rem .8rem; border: 1px dashed var(--line); border-radius: 6px; color: var(--muted); }
@media (max-width: 44rem) {
  .key-of-crops { display: block; }
  .worse td:first-child { min-width: 0; }
  .entry td, .pixels td, .worst-of td { padding: 0; }
}
)css";

}  // namespace rastercheck::reports
