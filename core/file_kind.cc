// SPDX-License-Identifier: BSD-3-Clause
#include "core/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "core/text.h"

namespace scoria::core {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view bytes;
  FileKind kind;
};

constexpr std::array kSignatures = {
    Signature{"\x89PNG"sv, {kPng, "a terrain names it: heightmap: {file: NAME.png}"}},
    Signature{"\x89MCAP"sv, {"an MCAP log", "render, replay and verify take it"}},
    Signature{"\x89HDF"sv, {"an HDF5 file", "write its series as CSV, say with h5py and pandas"}},
    Signature{"SQLite format 3"sv, {"an SQLite database", ""}},
    Signature{"#ROSBAG"sv, {"a ROS 1 bag", "convert: rosbags-convert --src IN.bag --dst OUT"}},
    Signature{"ULog\x01\x12\x35"sv, {"a PX4 ULog", "convert: ulog2csv IN.ulg"}},
    Signature{"\xa3\x95\x80\x80"sv,
              {"an ArduPilot log", "convert: mavlogdump.py --format csv --types T IN.bin"}},
    Signature{"MATLAB 5.0 MAT-file"sv, {"a MATLAB file", "write its series as CSV: writematrix"}},
    Signature{"\x93NUMPY"sv, {"a NumPy array", "write it as CSV: numpy.savetxt"}},
    Signature{"PAR1"sv, {"a Parquet file", "write it as CSV: pandas.read_parquet(IN).to_csv(OUT)"}},
    Signature{"\xff\xd8\xff"sv, {"a JPEG image", ""}},
    Signature{"GIF8"sv, {"a GIF image", ""}},
    Signature{"II*\0"sv, {"a TIFF image", "convert: gdal_translate -of AAIGrid IN OUT.asc"}},
    Signature{"MM\0*"sv, {"a TIFF image", "convert: gdal_translate -of AAIGrid IN OUT.asc"}},
    Signature{"%PDF"sv, {"a PDF", ""}},
    Signature{"\x7f"
              "ELF"sv,
              {"a program", ""}},
    Signature{"\x1f\x8b"sv, {"a gzip archive", "unpack it first"}},
    Signature{"\x28\xb5\x2f\xfd"sv, {"a Zstandard archive", "unpack it first"}},
    Signature{"PK\x03\x04"sv, {"a zip archive", "unpack it first"}},
    Signature{"\xff\xfe"sv, {"UTF-16 text", "save it as UTF-8"}},
    Signature{"\xfe\xff"sv, {"UTF-16 text", "save it as UTF-8"}},
    Signature{"version https://git-lfs"sv, {"a Git LFS pointer", "fetch the file: git lfs pull"}},
    Signature{"DSAA"sv, {"a Surfer grid", "convert: gdal_translate -of AAIGrid IN OUT.asc"}},
    Signature{"DSBB"sv, {"a Surfer grid", "convert: gdal_translate -of AAIGrid IN OUT.asc"}},
    Signature{"solid "sv, {"an STL mesh", "a URDF names it"}},
};

constexpr std::array kRoots = {
    Signature{"robot", {kUrdf, "a robot's YAML names it: urdf: NAME.urdf"}},
    Signature{"sdf", {"an SDF model", "a robot is a URDF"}},
    Signature{"mujoco", {"a MuJoCo model", "a robot is a URDF"}},
    Signature{"COLLADA", {"a Collada mesh", "a URDF names it"}},
    Signature{"html", {"an HTML page", "was it downloaded whole?"}},
};

constexpr std::string_view kBlank = " \t\r\n";

std::string_view SkipBlank(std::string_view text) {
  const std::size_t at = text.find_first_not_of(kBlank);
  return at == std::string_view::npos ? ""sv : text.substr(at);
}

bool StartsWithNoCase(std::string_view text, std::string_view word) {
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(), [](unsigned char a, unsigned char b) {
           return std::tolower(a) == std::tolower(b);
         });
}

/// The text from the root element's name on, past prolog and document type.
std::string_view RootElement(std::string_view xml) {
  while (xml.starts_with("<?") || xml.starts_with("<!")) {
    if (StartsWithNoCase(xml, "<!doctype html")) return "html";
    const std::size_t end = xml.find('>');
    if (end == std::string_view::npos) return "";
    xml = SkipBlank(xml.substr(end + 1));
  }
  return xml.starts_with('<') ? xml.substr(1) : ""sv;
}

FileKind KindOfXml(std::string_view head) {
  const std::string xml = BlankXmlComments(head);
  const std::string_view root = RootElement(SkipBlank(xml));
  for (const Signature& s : kRoots) {
    if (!StartsWithNoCase(root, s.bytes)) continue;
    const bool has_macros =
        xml.find("<xacro:") != std::string::npos || xml.find("${") != std::string_view::npos ||
        xml.find("$(find ") != std::string_view::npos || xml.find("$(arg ") != std::string::npos;
    if (s.kind.name == kUrdf && has_macros) return {kXacro, "expand it: xacro IN > OUT.urdf"};
    return s.kind;
  }
  return {"an XML file", ""};
}

bool IsEsriHeader(std::string_view text) {
  for (const std::string_view key : {"ncols"sv, "nrows"sv, "xllcorner"sv, "xllcenter"sv}) {
    if (!StartsWithNoCase(text, key)) continue;
    const std::string_view value = text.substr(key.size());
    return !value.empty() && kBlank.find(value.front()) != std::string_view::npos;
  }
  return false;
}

}  // namespace

FileKind KindOfContent(std::string_view head) {
  constexpr std::string_view kBom = "\xef\xbb\xbf";
  for (const Signature& s : kSignatures) {
    if (head.starts_with(s.bytes)) return s.kind;
  }
  if (head.size() > 8 && head.substr(4, 4) == "ftyp") return {"an MP4 video", ""};
  if (head.find('\0') != std::string_view::npos) return {"a binary file", ""};
  if (head.starts_with(kBom)) head.remove_prefix(kBom.size());
  head = SkipBlank(head);
  if (head.starts_with('<')) return KindOfXml(head);
  if (IsEsriHeader(head)) return {kEsriGrid, "a terrain names it: heightmap: {file: NAME.asc}"};
  return {"", ""};
}

std::string NotOfKind(const FileKind& kind, std::string_view wanted) {
  return fmt::format("is {}, not {}{}", kind.name, wanted,
                     kind.hint.empty() ? "" : fmt::format(" ({})", kind.hint));
}

}  // namespace scoria::core
