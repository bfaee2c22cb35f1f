#include "coupling/conform/counterpart.hpp"

#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include "coupling/base/stop.hpp"

namespace standoff::conform {
namespace {

constexpr std::uint32_t epoch = 1;
constexpr std::size_t kept_lines = 6;
constexpr auto slice = std::chrono::milliseconds(10);

std::set<std::string> files_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

std::string describe(const ProcessEnd& end) {
  return end.by_signal ? fmt::format("was killed by signal {}", end.number)
                       : fmt::format("ended with exit status {}", end.number);
}

}  // namespace

Counterpart::Counterpart(const std::vector<std::string>& command, const std::string& case_file)
    : endpoint_("ipc://" + folder_.path() + "/broker"),
      token_(launch::run_token()),
      router_(std::make_unique<Router>(parse_endpoint(endpoint_, false))) {
  own_files_ = files_in(folder_.path());
  launch::ChildCommand child{"participant", command, {{"OMP_WAIT_POLICY", "passive"}, {"OMP_NUM_THREADS", "1"}}};
  for (const std::string& word : {std::string("--case"), case_file, std::string("--connect"), endpoint_,
                                  std::string("--token"), token_, std::string("--threads"), std::string("1")})
    child.argv.push_back(word);
  child_ = launch::start_child(child);
}

Counterpart::~Counterpart() {
  child_.signal(SIGKILL);
  if (child_.alive && !end_) waitpid(child_.pid, nullptr, 0);
  child_.out.close(), child_.err.close();
}

double Counterpart::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::string Counterpart::said() const {
  std::string text;
  for (const std::string& line : child_.last_lines) text += (text.empty() ? "" : " / ") + line;
  return text.empty() ? "nothing" : text;
}

void Counterpart::say(const Message& body, const Payload* payload, const Spoil& spoil) {
  if (!router_ || address_.empty()) throw RuleBroken("nobody is connected");
  const bool rejecting = std::holds_alternative<message::Reject>(body);
  Envelope envelope{token_, rejecting ? 0 : epoch, ++sent_, "broker", window_};
  Frames frames = encode(envelope, body, payload);
  if (spoil) spoil(frames);
  router_->send(address_, std::move(frames));
  last_said_ = seconds();
  if (std::holds_alternative<message::Welcome>(body)) beating_ = true;
}

std::optional<Parcel> Counterpart::hear(double limit) {
  const double until = seconds() + limit;
  while (inbox_.empty()) {
    pump();
    if (!broken_.empty()) throw RuleBroken(broken_);
    if (!inbox_.empty()) break;
    if (end_ || lost_ || seconds() > until) return std::nullopt;
  }
  Parcel parcel = std::move(inbox_.front());
  inbox_.erase(inbox_.begin());
  return parcel;
}

Parcel Counterpart::expect_kind(std::size_t kind, double limit) {
  auto parcel = hear(limit);
  if (parcel && parcel->body.index() == kind) return std::move(*parcel);
  std::string instead = fmt::format("nothing came within {:g} s", limit);
  if (parcel) instead = fmt::format("{} came", message_name(parcel->body));
  if (parcel && std::holds_alternative<message::Abort>(parcel->body))
    instead += fmt::format(" ({})", std::get<message::Abort>(parcel->body).reason);
  if (!parcel && (end_ || lost_)) {
    reap();
    instead = end_ ? fmt::format("it {}, saying {}", describe(*end_), said()) : "its connection ended";
  }
  throw RuleBroken(fmt::format("{} was due, {}", message_name(kind), instead));
}

void Counterpart::expect_quiet(double limit) {
  if (const auto parcel = hear(limit)) throw RuleBroken(fmt::format("{} came unasked", message_name(parcel->body)));
  if (end_) throw RuleBroken(fmt::format("it {}, saying {}", describe(*end_), said()));
}

void Counterpart::call_off() {
  if (address_.empty() || lost_ || end_ || !router_) return;
  say(message::Abort{"broker", ExitCode::interrupted, "the rule has been judged", -1});
}

ProcessEnd Counterpart::wait_end(double limit) {
  const double until = seconds() + limit;
  while (!reap()) {
    if (seconds() > until) throw RuleBroken(fmt::format("it is still there after {:g} s", limit));
    pump();
  }
  pump();  // its last lines
  return *end_;
}

void Counterpart::pump() {
  child_.out.read_some([](const std::string&) {});
  child_.err.read_some([&](const std::string& line) {
    child_.last_lines.push_back(line);
    if (child_.last_lines.size() > kept_lines) child_.last_lines.erase(child_.last_lines.begin());
  });
  if (!router_) {
    std::this_thread::sleep_for(slice);
    return;
  }
  router_->wait(slice);
  const std::vector<std::string> gone = router_->take_gone();
  while (auto arrival = router_->receive()) {
    if (address_.empty()) address_ = arrival->address;
    if (arrival->address == address_) take(std::move(arrival->frames));
  }
  for (const std::string& address : gone) lost_ |= address == address_;
  if (beating_ && !lost_ && seconds() - last_said_ >= beat_interval_) say(message::Beat{});
  if (lost_) reap();
}

void Counterpart::take(Frames frames) {
  try {
    Parcel parcel = decode(std::move(frames));
    const Envelope& envelope = parcel.envelope;
    const char* name = message_name(parcel.body);
    if (!first_) first_ = envelope;
    if (envelope.token != token_) throw ProtocolError(fmt::format("{} carries another run token", name));
    if (envelope.sequence != ++heard_)
      throw ProtocolError(fmt::format("{} has sequence number {}, expected {}", name, envelope.sequence, heard_));
    if (envelope.sender != first_->sender)
      throw ProtocolError(
          fmt::format("{} is from \"{}\", HELLO was from \"{}\"", name, envelope.sender, first_->sender));
    const bool hello = std::holds_alternative<message::Hello>(parcel.body);
    if (envelope.epoch != (hello ? 0 : epoch))
      throw ProtocolError(fmt::format("{} belongs to connection {}, WELCOME gave {}", name, envelope.epoch, epoch));
    if (const auto* beat = std::get_if<message::Beat>(&parcel.body)) {
      beats_.push_back({seconds(), beat->progress});
    } else if (!std::holds_alternative<message::Progress>(parcel.body) &&
               !std::holds_alternative<message::Sample>(parcel.body)) {
      inbox_.push_back(std::move(parcel));
    }
  } catch (const ProtocolError& error) {
    if (broken_.empty()) broken_ = error.what();
  }
}

bool Counterpart::reap() {
  int status = 0;
  if (end_ || waitpid(child_.pid, &status, WNOHANG) != child_.pid) return end_.has_value();
  child_.alive = false;
  end_ = WIFEXITED(status) ? ProcessEnd{false, WEXITSTATUS(status)} : ProcessEnd{true, WTERMSIG(status)};
  return true;
}

std::string Counterpart::leftovers() const {
  std::string left;
  if (kill(-child_.pid, 0) == 0) left = "a process of its group";
  for (const std::string& name : files_in(folder_.path()))
    if (!own_files_.contains(name)) left += (left.empty() ? "" : ", ") + name + " beside the socket";
  return left;
}

}  // namespace standoff::conform
