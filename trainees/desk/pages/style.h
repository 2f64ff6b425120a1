// The style sheet of the desk, a file of its own, so that pages need no style of their own and the policy forbids any.
// Thread: any.
#pragma once

namespace trocar::review {

const char* style_sheet();

}  // namespace trocar::review
