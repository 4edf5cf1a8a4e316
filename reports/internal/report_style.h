#pragma once

#include <string_view>

namespace rastercheck::reports {

/// The style sheet of report.html. Tables become cards on a phone. Colours follow the reader's
/// light or dark mode. Nothing is loaded from elsewhere.
inline constexpr std::string_view kReportStyle = R"css(:root {
  --paper: #fbfbf9; --card: #ffffff; --ink: #1d2327; --muted: #5d666d; --line: #dcdfe0;
  --accent: #3a6ea5; --good: #1f7a4d; --bad: #b3202c; --warn: #8a5a00;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #15181b; --card: #1d2125; --ink: #e6e8ea; --muted: #9aa4ac; --line: #343a40;
    --accent: #78aee0; --good: #62c48f; --bad: #ff7a80; --warn: #e3b341;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif;
}
main { max-width: 80rem; margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
.name { margin: 0; color: var(--muted); letter-spacing: .04em; }
h1 { margin: 0 0 1.25rem; font-size: 1.9rem; line-height: 1.2; text-wrap: balance; }
h2 { margin: 2.75rem 0 1rem; font-size: 1.35rem; }
h3 { margin: 0 0 .5rem; font-size: 1.1rem; overflow-wrap: anywhere; }
h4 { margin: 1rem 0 .25rem; font-size: .9rem; color: var(--muted); font-weight: 600; }
small { font-weight: 400; color: var(--muted); }
p { margin: .5rem 0; }
a { color: var(--accent); }
.held { color: var(--good); } .violated { color: var(--bad); } .unchecked { color: var(--muted); }
td .held, td .violated { font-weight: 600; }
.unit { max-width: 62rem; color: var(--muted); font-size: .9rem; }
table { width: 100%; border-collapse: collapse; font-size: .92rem; }
th { text-align: left; vertical-align: bottom; font-weight: 600; white-space: nowrap; }
th, td { padding: .45rem .7rem; border-bottom: 1px solid var(--line); }
td { vertical-align: top; overflow-wrap: anywhere; }
th:first-child, td:first-child { padding-left: 0; }
th:last-child, td:last-child { padding-right: 0; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
td.number { white-space: nowrap; }
.facts { display: flex; flex-wrap: wrap; gap: .6rem 2rem; margin: 1rem 0; }
.facts div { min-width: 0; }
dt { font-size: .8rem; color: var(--muted); }
dd { margin: 0; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
code, .value { font-family: ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; }
code { font-size: .88em; overflow-wrap: anywhere; }
.value { font-size: .85em; overflow-wrap: anywhere; }
.pictures, .charts { display: grid; gap: 1rem; }
.pictures { grid-template-columns: repeat(auto-fit, minmax(min(22rem, 100%), 1fr)); }
.charts { grid-template-columns: repeat(auto-fit, minmax(min(20rem, 100%), 1fr)); }
figure { margin: 0; min-width: 0; }
.pictures figure {
  background: var(--card); border: 1px solid var(--line); border-radius: 6px; overflow: hidden;
}
.pictures img { display: block; width: 100%; height: auto; }
.pictures img.small { image-rendering: pixelated; }
figcaption { font-size: .88rem; color: var(--muted); }
.pictures figcaption { padding: .6rem .8rem; }
svg { display: block; width: 100%; max-width: 34rem; height: auto; }
svg rect { fill: var(--accent); } svg line { stroke: var(--muted); }
svg .axis { fill: var(--muted); font-size: 10px; }
.labels span {
  display: inline-block; margin: 0 .2rem .25rem 0; padding: 0 .5rem; border-radius: 4px;
  border: 1px solid var(--line); font-size: .85rem;
}
@media (max-width: 44rem) {
  h1 { font-size: 1.5rem; }
  thead { display: none; }
  tr {
    display: grid; grid-template-columns: repeat(6, 1fr); gap: .25rem .75rem; padding: .75rem 0;
    border-bottom: 1px solid var(--line);
  }
  td { padding: 0; border: 0; grid-column: 1 / -1; }
  td:first-child { font-weight: 600; }
  td.number { grid-column: span 2; text-align: left; white-space: normal; }
  td.number::before, td.named::before {
    display: block; content: attr(data-name); color: var(--muted); font-size: .75rem;
  }
  .verdicts > * > tr > td:nth-child(2), .verdicts > * > tr > td:nth-child(3) { grid-column: span 3; }
}
@media print { body { background: none; } }
)css";

}  // namespace rastercheck::reports
