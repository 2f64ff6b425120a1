// The files of this folder as text, put into the program when it is built (cmake/embed.cmake). The policy of the pages
// forbids styles and scripts of their own. Thread: any.
#pragma once

namespace trocar::review {

/// Text holds 4.5:1 on its ground, lines and shapes 3:1; hues of Okabe and Ito; state is always shape and word too.
const char* style_sheet();  // desk.css
/// The attempt page follows the slider, and what changes by itself is renewed, without loading the page anew.
/// Everything works without it.
const char* desk_script();  // desk.js
/// What browsers ask for and show in the tab: an instrument through its port.
const char* desk_icon();  // icon.svg

}  // namespace trocar::review
