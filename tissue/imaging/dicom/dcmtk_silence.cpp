#include "tissue/imaging/dicom/dcmtk_silence.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/oflog/oflog.h>
#include <fcntl.h>
#include <unistd.h>

namespace trocar {

void silence_dcmtk() {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  dup2(nowhere, 1);
  dup2(nowhere, 2);
  close(nowhere);
}

}  // namespace trocar
