// Keeps dcmtk quiet and its messages (which may quote a file's contents) away from every output. Frames and contours
// are read in child processes.
//
// Thread: any.
#pragma once

namespace trocar {

/// Loads dcmtk's dictionary in the parent (70 ms), so that children find it loaded.
void load_dcmtk_dictionary();

/// Switches dcmtk's logging off and closes standard output and error of this process.
void silence_dcmtk();

}  // namespace trocar
