#include "trainees/review/style.h"

namespace trocar::review {

const char* style_sheet() {
  return R"css(:root { color-scheme: light dark; --ink: #1b1f24; --paper: #fbfbf9; --quiet: #5c6670; --accent: #0072b2; --warn: #d55e00; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8eaec; --paper: #16191d; --quiet: #9aa4ae; --accent: #56b4e9; --warn: #e69f00; } }
body { margin: 0; font: 16px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--paper); }
a { color: var(--accent); }
.plain main { max-width: 26rem; margin: 12vh auto; padding: 0 1rem; }
.plain h1 { font-size: 1.4rem; }
.plain input { width: 100%; box-sizing: border-box; font: inherit; padding: 0.5rem; }
.plain button { font: inherit; padding: 0.5rem 1.5rem; }
.message { border-left: 4px solid var(--warn); padding-left: 0.75rem; }
.quiet { color: var(--quiet); font-size: 0.9rem; }
)css";
}

}  // namespace trocar::review
