#pragma once
// The bodies of messages to and from their protobuf classes; shared by the codec's files only.
#include <standoff/wire/envelope.pb.h>

#include "coupling/session/messages.hpp"

namespace standoff {

void put_body(const Message& body, wire::Envelope& into);
/// Throws ProtocolError for a body this version does not know or whose members are out of range.
Message get_body(const wire::Envelope& from);

}  // namespace standoff
