#include "coupling/conform/judgement.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace standoff::conform {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += ' ';
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string verdict_text(const Verdict& verdict) {
  return fmt::format("{}  {:16} {}\n{}", verdict.passed ? "PASS" : "FAIL", verdict.rule->name, verdict.rule->text,
                     verdict.passed ? "" : "      " + verdict.reason + "\n");
}

std::string junit_text(const std::string& suite, const std::vector<Verdict>& verdicts) {
  const auto failures = std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.passed; });
  std::string text =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
                  escaped(suite), verdicts.size(), failures);
  for (const Verdict& verdict : verdicts) {
    text += fmt::format("  <testcase classname=\"conform\" name=\"{}\" time=\"{:.3f}\"", verdict.rule->name,
                        verdict.seconds);
    text += verdict.passed ? "/>\n" : fmt::format("><failure message=\"{}\"/></testcase>\n", escaped(verdict.reason));
  }
  return text + "</testsuite>\n";
}

}  // namespace standoff::conform
