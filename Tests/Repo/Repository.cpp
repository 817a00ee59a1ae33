// Reads the repository once, without git's own files and build folders.
#include "Repository.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace Lantern::Repo
{

namespace fs = std::filesystem;

namespace
{

bool IsForeign(const fs::path& Name)
{
	const std::string Text = Name.string();
	const bool bOurs = Text[0] != '.' || Text == ".ci" || Text == ".github" || !fs::is_directory(GetRoot() / Name);
	return !bOurs || Text.rfind("Build", 0) == 0;
}

bool IsText(const fs::path& Path)
{
	static constexpr std::array Binary = {".png", ".exr", ".pfm", ".jpg", ".bin", ".glb", ".spv"};
	const std::string Extension = Path.extension().string();
	return std::find(Binary.begin(), Binary.end(), Extension) == Binary.end();
}

std::vector<std::string_view> SplitLines(std::string_view Text)
{
	std::vector<std::string_view> Lines;
	while (!Text.empty())
	{
		const size_t End = std::min(Text.find('\n'), Text.size());
		Lines.push_back(Text.substr(0, End));
		Text.remove_prefix(std::min(End + 1, Text.size()));
	}
	return Lines;
}

std::vector<FTextFile> ReadAll()
{
	std::vector<FTextFile> Files;
	fs::recursive_directory_iterator It(GetRoot());
	for (; It != fs::recursive_directory_iterator(); ++It)
	{
		const fs::path Relative = It->path().lexically_relative(GetRoot());
		if (It.depth() == 0 && IsForeign(Relative)) { It.disable_recursion_pending(); }
		// The corpora of the fuzzers are deliberately not what their names say.
		if (It->is_directory() && Relative.filename() == "Corpus") { It.disable_recursion_pending(); }
		if (It->is_regular_file() && IsText(Relative))
		{
			std::ifstream Stream(It->path(), std::ios::binary);
			FTextFile File{Relative.generic_string(), std::string(std::istreambuf_iterator<char>(Stream), {}), {}};
			Files.push_back(std::move(File));
		}
	}
	std::sort(Files.begin(), Files.end(), [](const FTextFile& A, const FTextFile& B) { return A.Path < B.Path; });
	for (FTextFile& File : Files) { File.Lines = SplitLines(File.Text); }
	return Files;
}

} // namespace

fs::path GetRoot() { return LANTERN_SOURCE_DIR; }

const std::vector<FTextFile>& GetFiles()
{
	static const std::vector<FTextFile> Files = ReadAll();
	return Files;
}

bool IsUnder(const FTextFile& File, std::string_view Folder)
{
	return File.Path.size() > Folder.size() && File.Path.compare(0, Folder.size(), Folder) == 0 && File.Path[Folder.size()] == '/';
}

bool IsDocument(const FTextFile& File)
{
	return File.Path == "README.md" || File.Path == "CONTRIBUTING.md" || (IsUnder(File, "Docs") && HasExtension(File, {".md"}));
}

bool HasExtension(const FTextFile& File, std::initializer_list<std::string_view> Extensions)
{
	const std::string Extension = fs::path(File.Path).extension().string();
	return std::find(Extensions.begin(), Extensions.end(), Extension) != Extensions.end();
}

bool IsCpp(const FTextFile& File)
{
	return HasExtension(File, {".h", ".cpp"}) && (IsUnder(File, "Source") || IsUnder(File, "Programs") || IsUnder(File, "Tests"));
}

std::string_view GetInclude(std::string_view Line)
{
	const size_t Hash = Line.find_first_not_of(" \t");
	if (Hash == std::string_view::npos || Line[Hash] != '#') { return {}; }
	const size_t Word = Line.find("include", Hash);
	const size_t Open = Word == std::string_view::npos ? Word : Line.find_first_of("<\"", Word);
	if (Open == std::string_view::npos) { return {}; }
	const size_t Close = Line.find_first_of(">\"", Open + 1);
	return Close == std::string_view::npos ? std::string_view{} : Line.substr(Open + 1, Close - Open - 1);
}

std::string At(const FTextFile& File, size_t LineIndex) { return File.Path + ":" + std::to_string(LineIndex + 1); }

} // namespace Lantern::Repo
