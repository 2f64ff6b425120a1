// Keeps dcmtk quiet and its messages (which may quote a file's contents) away from every output. For child processes only.
//
// Thread: any.
#pragma once

namespace trocar {

/// Switches dcmtk's logging off and closes standard output and error of this process.
void silence_dcmtk();

}  // namespace trocar
