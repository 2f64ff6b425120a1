// Certificates for other programs: what they certify, by whom, on which attempts, and whether they hold today. Thread:
// the Database's.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "trainees/exchange/export/export_choice.h"
#include "trainees/exchange/export/xapi.h"
#include "trainees/records/certificate_standing.h"

namespace trocar {

struct ExportedCertificate {
  Certificate certificate = {};
  std::string trainee_uuid = {};
  CertificateStanding standing = {};
  std::string revocation_uuid = {}, revoked_by = {}, revoked_by_account = {};  ///< "" while it is not withdrawn
  std::string questioned_by = {}, questioned_utc = {};  ///< the newest decision that puts it in question; "" none

  /// "holds", "in question" (a person is to look: it still stands), "withdrawn".
  std::string state() const;
};

/// Those of the chosen trainees, and of the chosen exercise, oldest first; none where one attempt alone was chosen.
std::vector<ExportedCertificate> chosen_certificates(Database& database, const ExportChoice& choice);

/// One line a certificate, as the other tables: docs/exports.md.
void write_certificates_csv(const std::vector<ExportedCertificate>& certificates, std::ostream& out);

/// The same fields as a JSON array of an object each.
std::string certificates_json(const std::vector<ExportedCertificate>& certificates);

/// What a record store keeps of a certificate. Statements never change once they are sent, so what happens to a
/// certificate is a statement of its own: "earned"; "questioned" while it is in question; one that voids "earned" when
/// it was withdrawn. `about` names what a statement stands for: of each at most one holds at a time.
std::vector<XapiSubject> certificate_subjects(const ExportedCertificate& certificate, const XapiSetting& setting);

}  // namespace trocar
