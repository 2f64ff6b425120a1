#include "tissue/imaging/dicom/dcmtk_silence.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/oflog/oflog.h>
#include <fcntl.h>
#include <unistd.h>

namespace trocar {

void load_dcmtk_dictionary() {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  dcmDataDict.rdlock();
  dcmDataDict.rdunlock();
}

void silence_dcmtk() {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  dup2(nowhere, 1);
  dup2(nowhere, 2);
  close(nowhere);
}

}  // namespace trocar
