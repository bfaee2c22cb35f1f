#pragma once
// Keys of CURVE, ZeroMQ's encryption and authentication (rfc.zeromq.org/spec/26): for tcp beyond this machine. Each
// side has a pair. A broker lets in the public keys of its list; a participant speaks to the one broker whose public
// key it was given. Keys are 40 characters of Z85, one a line in a file; a secret one is readable by its owner alone.
#include <string>
#include <vector>

namespace standoff {

struct CurveKeys {
  std::string secret;                // own; empty: no encryption
  std::string server;                // participant: its broker's public key
  std::vector<std::string> allowed;  // broker: public keys it lets in
  bool on() const { return !secret.empty(); }
};

/// Reads key files; empty names are left out. Throws Stop(bad_case) for a file that cannot be read, holds no keys, or
/// is a secret that others can read; and for a secret without the other side's key.
CurveKeys read_broker_keys(const std::string& secret_file, const std::string& allow_file);
CurveKeys read_participant_keys(const std::string& secret_file, const std::string& server_file);
/// Writes a new pair, PREFIX.secret (mode 0600) and PREFIX.public. Throws Stop(bad_case) if one is there already.
void write_new_keys(const std::string& prefix);

}  // namespace standoff
