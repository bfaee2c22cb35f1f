#pragma once
// The answer, as printed at the end of a run: ours beside what the paper computed and what was measured, then what
// makes it believable: the books, the certificate of rest, where the time went.
#include <string>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "coupling/launcher/run_record.hpp"

namespace standoff::launch {

std::string result_table(const OrderedJson& record, const std::vector<ReferenceValue>& references);

/// Warnings about a finished run that a reader must not miss: not at rest, books that do not close.
std::vector<std::string> result_warnings(const OrderedJson& record);

}  // namespace standoff::launch
