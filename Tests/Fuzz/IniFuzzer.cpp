// Any bytes as an ini file: first as syntax, then as each kind of file that a Config folder holds.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "LanternCore/Config/Config.h"
#include "LanternCore/Config/IniFile.h"
#include "LanternCore/Text/Log.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

TRTConsoleVariable<bool> CVarBool("r.RT.Shadow", true, "");
TRTConsoleVariable<int32_t> CVarInt("r.RT.Shadow.Samples", 1, "", {1, 64});
TRTConsoleVariable<float> CVarFloat("r.RT.Shadow.MaxDistance", 1.0f, "", {0.0, 1e6});
TRTConsoleVariable<std::string> CVarString("r.RT.Name", "", "");

void Require(bool bCondition)
{
	if (!bCondition) std::abort();
}

/// But for tabs within it; the rest is the file's, UTF-8 or not.
bool HasControl(std::string_view Text)
{
	for (const char C : Text)
		if ((static_cast<unsigned char>(C) < 0x20 && C != '\t') || C == 0x7f) return true;
	return false;
}

void RequireClean(const FConfigProblems& Problems)
{
	for (const std::string& Problem : Problems) Require(IsCleanText(Problem) && Problem.size() < 1000);
}

/// One folder per process: libFuzzer may run several.
const FConfigFolder& GetFolder()
{
	static const FConfigFolder Folder = [] {
		std::string Pattern = (std::filesystem::temp_directory_path() / "lantern-ini-XXXXXX").string();
		Require(::mkdtemp(Pattern.data()) != nullptr);
		return FConfigFolder{Pattern};
	}();
	return Folder;
}

void CheckSyntax(std::string_view Text)
{
	const FIniFile File = FIniFile::Parse(Text, "Fuzz.ini");
	Require(File.GetProblems().size() <= 101);
	RequireClean(File.GetProblems());
	FIniResolver Resolver;
	for (const FIniSection& Section : File.GetSections())
	{
		Require(File.FindSection(Section.Name) == &Section);
		for (const FIniEntry& Entry : Section.Entries)
			Require(!Entry.Key.empty() && !HasControl(Section.Name) && Entry.Line >= Section.Line);
		// Twice: as a profile that is its own base.
		Resolver.Apply(File, Section);
		Resolver.Apply(File, Section);
	}
	for (const FIniValue& Value : Resolver.GetValues()) Require(!Value.Key.empty());
}

void CheckMeaning(std::string_view Text, const std::string& Path)
{
	std::ofstream(Path, std::ios::binary) << Text;
	const FConfigFolder& Folder = GetFolder();
	// Aliases stay for the life of the process; with too many of them each unknown name would take long.
	if (FConsoleVariables::Get().GetAliases().size() < 20) RequireClean(LoadAliases(Folder));
	RequireClean(LoadFile(Folder, Folder.GetDefaults()));
	RequireClean(LoadScalability(Folder, ERTQuality::Epic));
	RequireClean(LoadDeviceProfile(Folder, "llvmpipe (LLVM 15.0.6, 256 bits)").Problems);
	ListConsoleVariables(Folder);
	FConsoleVariables::Get().BeginFrame();
	Require(CVarInt.GetOnRenderThread() >= 1 && CVarInt.GetOnRenderThread() <= 64);
	Require(CVarFloat.GetOnRenderThread() >= 0.0f && CVarFloat.GetOnRenderThread() <= 1e6f);
	FConsoleVariables::Get().ToJson();
	FConsoleVariables::Get().ToMarkdown();
	FConsoleVariables::Get().ResetAll();
	std::filesystem::remove(Path);
}

} // namespace
} // namespace Lantern

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* Data, size_t Size)
{
	using namespace Lantern;
	SetLogSink([](ERTLogLevel, std::string_view) {});
	const std::string_view Text(reinterpret_cast<const char*>(Data), Size);
	CheckSyntax(Text);
	const FConfigFolder& Folder = GetFolder();
	const std::string Paths[] = {Folder.GetAliases(), Folder.GetDefaults(), Folder.GetScalability(), Folder.GetDeviceProfiles()};
	// The last byte chooses, so that the text itself stays an ini file.
	CheckMeaning(Text, Paths[Size > 0 ? Data[Size - 1] % std::size(Paths) : 0]);
	return 0;
}
