#include "trainees/exchange/lrs/lrs_delivery.h"

#include <algorithm>
#include <set>
#include <thread>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "haptics/utf8.h"
#include "trainees/exchange/lrs/delivery_record.h"
#include "trainees/exchange/lrs/record_store.h"
#include "trainees/records/demo_record.h"

namespace trocar {
namespace {

using lrs::Answer;
using lrs::DeliveryRecord;
using lrs::RecordStore;
using std::chrono::milliseconds;

constexpr milliseconds kFirstWait{500}, kLongestWait{60000};
constexpr std::size_t kShownBody = 200;

/// A statement on its way. @param voids identifier of what it takes back; "" for all others
struct Parcel {
  XapiStatement statement;
  std::string about, voids = {};
};

std::string shown(const Answer& answer) {
  const std::string body = harmless(answer.body.substr(0, kShownBody));
  return "HTTP " + std::to_string(answer.status) + (body.empty() ? "" : ": " + body);
}

/// Worth another try later: nothing came, the store is busy or has a fault.
bool passing(const Answer& answer) {
  return answer.status == 0 || answer.status == 408 || answer.status == 425 || answer.status == 429 ||
         answer.status >= 500;
}

class Delivery {
 public:
  Delivery(const DeliveryOptions& options, DeliveryRecord& record) : options_(&options), record_(&record) {}

  /// Whether it is a record store, and which version both speak.
  void greet() {
    const Answer answer = patiently([&] { return store().about(); });
    const auto about = nlohmann::json::parse(answer.body, nullptr, false);
    if (answer.status != 200) require_understood(answer);
    if (answer.status != 200 || !about.is_object() || !about.contains("version") || !about["version"].is_array())
      throw InputError(options_->lrs.url + ": no record store answers there (asked for /about: " + shown(answer) + ")");
    std::string best;
    for (const auto& version : about["version"]) {
      const std::string name = version.is_string() ? version.get<std::string>() : "";
      if (name.starts_with("2.0.") || name.starts_with("1.0.")) best = std::max(best, name);
    }
    if (best.empty()) throw InputError(options_->lrs.url + ": speaks neither xAPI 1.0 nor 2.0");
    store().speak(best);
  }

  void send(const std::vector<Parcel>& parcels) {
    all_ = parcels.size();
    // A statement that takes back comes after what it takes back, in a request of its own.
    for (std::size_t from = 0; from < parcels.size();) {
      std::size_t to = from + 1;
      const bool voids = is_voiding(parcels[from]);
      while (to < parcels.size() && to - from < options_->at_once && is_voiding(parcels[to]) == voids) ++to;
      some({parcels.begin() + static_cast<std::ptrdiff_t>(from), parcels.begin() + static_cast<std::ptrdiff_t>(to)});
      from = to;
    }
  }

  DeliveryReport report;

 private:
  static bool is_voiding(const Parcel& parcel) {
    return parcel.statement.text.find("\"http://adlnet.gov/expapi/verbs/voided\"") != std::string::npos;
  }

  RecordStore& store() { return store_; }

  /// A store refuses a request as a whole: then the halves are tried, so that each statement gets an answer of its own.
  void some(const std::vector<Parcel>& parcels) {
    if (parcels.size() == 1) return one(parcels.front());
    std::vector<XapiStatement> statements;
    for (const Parcel& parcel : parcels) statements.push_back(parcel.statement);
    const Answer answer = patiently([&] { return store().post(statements); });
    if (answer.status == 200 && names_all(answer.body, statements)) {
      report.delivered += static_cast<int>(parcels.size());
      return keep(parcels);
    }
    require_understood(answer);
    const auto middle = parcels.begin() + static_cast<std::ptrdiff_t>(parcels.size() / 2);
    some({parcels.begin(), middle});
    some({middle, parcels.end()});
  }

  void one(const Parcel& parcel) {
    const Answer answer = patiently([&] { return store().put(parcel.statement); });
    if (answer.status == 204 || answer.status == 409) {  // 409: it is there, as it was when it was sent first
      report.delivered += answer.status == 204;
      report.different += answer.status == 409;
      return keep({parcel});
    }
    require_understood(answer);
    report.refused.push_back(parcel.about + ": " + shown(answer));
    going(1);
  }

  /// What holds for the next request as well. @throws InputError.
  void require_understood(const Answer& answer) const {
    const std::string& url = options_->lrs.url;
    if (answer.status == -1)
      throw EnvironmentError(url + ": its certificate does not hold: " + answer.failure +
                             "; --ca-file names the certificate of who signed it");
    if (answer.status == 401 || answer.status == 403)
      throw InputError(url + ": user or password is refused, or may not write (" + shown(answer) + ")");
    if (answer.status == 404 || answer.status == 405)
      throw InputError(url + ": takes no statements (" + shown(answer) + ")");
    if (answer.status >= 300 && answer.status < 400)
      throw InputError(url + ": points to another address (" + shown(answer) + "): give that one");
    if (answer.status >= 200 && answer.status < 300)
      throw InputError(url + ": what answers does not say that it took the statements (" + shown(answer) + ")");
  }

  static bool names_all(const std::string& body, const std::vector<XapiStatement>& statements) {
    const auto ids = nlohmann::json::parse(body, nullptr, false);
    if (!ids.is_array()) return false;
    std::set<std::string> there;
    for (const auto& id : ids)
      if (id.is_string()) there.insert(id.get<std::string>());
    return std::all_of(statements.begin(), statements.end(),
                       [&](const XapiStatement& one) { return there.contains(one.id); });
  }

  void keep(const std::vector<Parcel>& parcels) {
    std::vector<lrs::Delivered> delivered;
    for (const Parcel& parcel : parcels) delivered.push_back({parcel.statement.id, parcel.about});
    record_->add(delivered);
    for (const Parcel& parcel : parcels) {
      if (parcel.voids.empty()) continue;
      record_->add_taken_back(parcel.voids);
      ++report.taken_back;
    }
    going(parcels.size());
  }

  void going(std::size_t more) {
    done_ += more;
    if (options_->going) options_->going(done_, all_);
  }

  /// Waits twice as long each time, or as the store asks, until the patience is at its end.
  template <class Ask>
  Answer patiently(const Ask& ask) {
    for (milliseconds next = kFirstWait;; next = std::min(2 * next, kLongestWait)) {
      const auto asked = std::chrono::steady_clock::now();
      Answer answer = ask();
      if (!passing(answer)) return answer;
      waited_ += std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - asked);
      const std::string why = answer.status == 0 ? answer.failure : shown(answer);
      const milliseconds wait =
          std::max<milliseconds>(next, std::chrono::seconds(std::min(answer.retry_after_s, 3600L)));
      if (waited_ + wait > options_->patience)
        throw EnvironmentError(options_->lrs.url + ": " + why + "; " + std::to_string(report.delivered) +
                               " statements were delivered and stay, the same command goes on from there");
      if (options_->log) options_->log(why + "; tries again in " + std::to_string((wait.count() + 999) / 1000) + " s");
      waited_ += wait;
      if (options_->wait)
        options_->wait(wait);
      else
        std::this_thread::sleep_for(wait);
    }
  }

  const DeliveryOptions* options_;
  DeliveryRecord* record_;
  RecordStore store_{options_->lrs};
  milliseconds waited_{0};
  std::size_t done_ = 0, all_ = 0;
};

}  // namespace

DeliveryReport deliver_to_lrs(Database& database, const ExportChoice& choice, const PassMark& pass_mark,
                              const DeliveryOptions& options) {
  require_no_demo(database, "nothing is sent from it");
  std::string store = options.lrs.url;
  while (store.ends_with('/')) store.pop_back();
  DeliveryRecord record(database.file(), store);
  Delivery delivery(options, record);
  std::vector<Parcel> parcels;
  for (XapiSubject& subject : xapi_subjects(database, choice, options.setting, pass_mark)) {
    // Of what the record no longer says: first that it does not hold, then what does.
    for (const lrs::Delivered& old : record.holding(subject.about)) {
      if (subject.statement && old.id == subject.statement->id) continue;
      parcels.push_back({voiding_statement(old.id, "", "", options.setting), "end of " + subject.about, old.id});
    }
    if (!subject.statement) continue;
    if (record.has(subject.statement->id))
      ++delivery.report.before;
    else
      parcels.push_back({std::move(*subject.statement), subject.about});
  }
  if (!parcels.empty()) {
    delivery.greet();
    delivery.send(parcels);
  }
  return delivery.report;
}

}  // namespace trocar
