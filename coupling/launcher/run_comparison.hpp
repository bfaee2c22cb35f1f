#pragma once
// What differs between two runs: inputs of their resolved cases, results, books, timings, origin. Pure functions.
#include <map>
#include <string>

#include "coupling/case/document.hpp"
#include "coupling/launcher/run_record.hpp"

namespace standoff::launch {

/// Values of a resolved case by dotted key, as written. Levels and references are left out: what a level chose is in
/// the values, and a reference changes nothing.
std::map<std::string, std::string> flat_inputs(const Node& document);

struct ComparedRun {
  std::string folder;
  OrderedJson record;                         // run.json
  std::map<std::string, std::string> inputs;  // of case.resolved.toml
};

/// Reads a run folder; Stop(bad_case) if it is none. A run without a resolved case has no inputs.
ComparedRun compared_run(const std::string& folder);

/// {runs[], inputs[{key, a, b}], results[{key, a, b, difference, relative}], conservation[], counts[], timing[] alike,
/// provenance[{key, a, b}], same_bits}. Results are listed even where equal; inputs, provenance only where different.
/// difference = b - a; relative = (b - a) / |a|, null for a = 0. same_bits: both ended with the same state hash.
OrderedJson comparison_json(const ComparedRun& a, const ComparedRun& b);
std::string comparison_text(const OrderedJson& comparison);

}  // namespace standoff::launch
