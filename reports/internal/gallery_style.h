#pragma once

#include <string_view>

namespace rastercheck::reports {

/// The styles that the gallery's page adds to the report's style sheet (report_style.h): for a
/// picture beside its errors (above them on a phone), for curves, and for strips of frames.
/// Animations stop under the pointer, in print, and for readers who ask for less motion.
inline constexpr std::string_view kGalleryStyle = R"css(:root {
  --curve-0: #1d2327; --curve-1: #b3202c; --curve-2: #c2660c; --curve-3: #2b6cb0; --curve-4: #1f7a4d;
}
@media (prefers-color-scheme: dark) {
  :root {
    --curve-0: #e6e8ea; --curve-1: #ff7a80; --curve-2: #f0a35a; --curve-3: #78aee0;
    --curve-4: #62c48f;
  }
}
.lead, .drawn p { max-width: 46rem; }
nav ul { margin: 1rem 0; padding: 0; list-style: none; columns: 20rem; }
nav li { padding: .2rem 0; break-inside: avoid; }
.drawn { border-top: 1px solid var(--line); margin-top: 2.5rem; }
.drawn h2 { margin: 1.5rem 0 0; }
.source { color: var(--muted); font-size: .9rem; }
.panels { display: grid; gap: 1rem; margin-top: 1.25rem; align-items: start; }
.panels { grid-template-columns: repeat(auto-fill, minmax(min(31rem, 100%), 1fr)); }
.panel, .plots figure {
  background: var(--card); border: 1px solid var(--line); border-radius: 6px; padding: .8rem;
}
.panel.wide { grid-column: 1 / -1; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: .8rem; margin-top: .6rem; }
.top { display: flex; flex-wrap: wrap; gap: 0 2rem; align-items: center; }
.top .pair { flex: 1 1 20rem; max-width: 32rem; }
.top .facts { flex: 1 1 14rem; }
.pair img { display: block; width: 100%; height: auto; border-radius: 2px; }
.pair p, .still p { margin: .35rem 0 0; font-size: .85rem; color: var(--muted); }
.panel figcaption strong { display: block; font-size: 1rem; color: var(--ink); }
.panel .facts { margin: .8rem 0 0; gap: .3rem 1.6rem; }
.panel dd { font-size: .92rem; }
svg.legend { margin: .5rem auto 0; max-width: 22rem; }
.absent { color: var(--muted); margin: .6rem 0 0; }
.plots { display: grid; gap: 1rem; margin-top: 1.25rem; align-items: start; }
.plots { grid-template-columns: repeat(auto-fill, minmax(min(26rem, 100%), 1fr)); }
svg.curves { max-width: none; }
svg .plot { fill: none; stroke: var(--line); }
svg line.grid { stroke: var(--line); }
svg .curve { fill: none; stroke-width: 1.8; }
svg .key { fill: var(--ink); font-size: 13px; }
svg .axis { font-size: 11px; }
svg.curves .axis { font-size: 12px; }
.frames { display: grid; grid-template-columns: repeat(var(--frames), 1fr); gap: .5rem; margin-top: .6rem; }
.frames div, .moving {
  aspect-ratio: 1; background-size: calc(var(--frames) * 100%) 100%; print-color-adjust: exact;
  -webkit-print-color-adjust: exact;
}
.moving { animation: frames 4s steps(var(--frames), jump-none) infinite; border-radius: 2px; }
.pair:hover .moving { animation-play-state: paused; }
@keyframes frames { from { background-position: 0 0; } to { background-position: 100% 0; } }
@media (prefers-reduced-motion: reduce) { .moving { animation: none; } }
@media (max-width: 44rem) {
  .pair { grid-template-columns: 1fr; }
  .frames { grid-template-columns: repeat(4, 1fr); }
}
@media print { .moving { animation: none; } .panel, .plots figure { break-inside: avoid; } }
)css";

}  // namespace rastercheck::reports
