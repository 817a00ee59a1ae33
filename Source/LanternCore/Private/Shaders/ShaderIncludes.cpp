// Reads shader files and resolves their #include lines to a tree.
#include "Shaders/ShaderIncludes.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <xxhash.h>

#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace fs = std::filesystem;

namespace
{

/// Blanks out comments but keeps line breaks, so that line numbers stay true.
std::string StripComments(std::string_view Text)
{
	std::string Out(Text);
	enum class EState
	{
		Code,
		Line,
		Block
	} State = EState::Code;
	for (size_t I = 0; I < Out.size(); ++I)
	{
		const char C = Out[I];
		const char Next = I + 1 < Out.size() ? Out[I + 1] : '\0';
		if (C == '\n')
		{
			State = State == EState::Line ? EState::Code : State;
			continue;
		}
		if (State == EState::Block && C == '*' && Next == '/')
		{
			Out[I] = Out[I + 1] = ' ';
			++I;
			State = EState::Code;
			continue;
		}
		if (State == EState::Code && C == '/' && (Next == '/' || Next == '*'))
		{
			State = Next == '/' ? EState::Line : EState::Block;
			Out[I] = Out[I + 1] = ' ';
			++I;
			continue;
		}
		if (State != EState::Code) { Out[I] = ' '; }
	}
	return Out;
}

std::string_view TrimLeft(std::string_view Text)
{
	const size_t First = Text.find_first_not_of(" \t\r");
	return First == std::string_view::npos ? std::string_view() : Text.substr(First);
}

bool ParseIncludeLine(std::string_view Line, FIncludeLine& Out)
{
	constexpr std::string_view Word = "include";
	Line = TrimLeft(Line);
	if (Line.empty() || Line.front() != '#') { return false; }
	Line = TrimLeft(Line.substr(1));
	if (!Line.starts_with(Word)) { return false; }
	Line = TrimLeft(Line.substr(Word.size()));
	if (Line.empty() || (Line.front() != '"' && Line.front() != '<')) { return false; }
	Out.bQuoted = Line.front() == '"';
	const size_t End = Line.find(Out.bQuoted ? '"' : '>', 1);
	if (End == std::string_view::npos) { return false; }
	Out.Name = Line.substr(1, End - 1);
	return !Out.Name.empty();
}

} // namespace

std::vector<FIncludeLine> FindIncludeLines(std::string_view Text)
{
	std::vector<FIncludeLine> Lines;
	const std::string Code = StripComments(Text);
	const std::string_view View = Code;
	uint32_t Number = 1;
	for (size_t Begin = 0; Begin < View.size(); ++Number)
	{
		const size_t End = std::min(View.find('\n', Begin), View.size());
		FIncludeLine Line;
		if (ParseIncludeLine(View.substr(Begin, End - Begin), Line))
		{
			Line.Line = Number;
			Lines.push_back(std::move(Line));
		}
		Begin = End + 1;
	}
	return Lines;
}

FHash128 HashBytes(std::string_view Bytes)
{
	const XXH128_hash_t Hash = XXH3_128bits(Bytes.data(), Bytes.size());
	return {Hash.low64, Hash.high64};
}

std::shared_ptr<const FShaderFile> MakeShaderFile(std::string Text)
{
	auto File = std::make_shared<FShaderFile>();
	File->Text = std::move(Text);
	File->Includes = FindIncludeLines(File->Text);
	File->Hash = HashBytes(File->Text);
	return File;
}

std::shared_ptr<const FShaderFile> FShaderFileCache::Read(const fs::path& Path)
{
	std::error_code Code;
	if (!fs::is_regular_file(Path, Code) || Code) { return nullptr; }
	const fs::file_time_type Modified = fs::last_write_time(Path, Code);
	const uintmax_t Size = Code ? 0 : fs::file_size(Path, Code);
	if (Code) { return nullptr; }
	const std::string Id = Path.string();
	{
		std::lock_guard Lock(Mutex);
		const auto It = Entries.find(Id);
		if (It != Entries.end() && It->second.bSettled && It->second.Modified == Modified && It->second.Size == Size)
		{
			return It->second.File;
		}
	}
	std::ifstream Stream(Path, std::ios::binary);
	if (!Stream) { return nullptr; }
	auto File = MakeShaderFile(std::string(std::istreambuf_iterator<char>(Stream), std::istreambuf_iterator<char>()));
	// File times have the resolution of a clock tick or worse. A file just written may be written again without a new time, so
	// it is read again until it is older than that.
	const bool bSettled = fs::file_time_type::clock::now() - Modified > std::chrono::seconds(2);
	std::lock_guard Lock(Mutex);
	Entries[Id] = {Modified, Size, bSettled, File};
	return File;
}

struct FIncludeResolver::FWalk
{
	FIncludeTree& Tree;
	const FShaderSource& Source;
	const std::vector<FShaderHeader>& Common;
	std::unordered_map<std::string, int> ByLocation;
	std::vector<int> Stack;

	const FShaderHeader* FindHeader(const fs::path& Include) const
	{
		const std::string Name = Include.lexically_normal().generic_string();
		for (const std::vector<FShaderHeader>* const List : {&Source.Headers, &Common})
		{
			const auto Is = [&](const FShaderHeader& Header) { return Header.Include == Name; };
			if (const auto Found = std::find_if(List->begin(), List->end(), Is); Found != List->end()) { return &*Found; }
		}
		return nullptr;
	}
};

FIncludeResolver::FIncludeResolver(
    const std::vector<std::string>& InSearchFolders, std::vector<FShaderHeader> InHeaders, FShaderFileCache& InFiles)
    : Headers(std::move(InHeaders)),
      Files(InFiles)
{
	for (const std::string& Folder : InSearchFolders)
	{
		Folders.push_back(fs::path(Folder).lexically_normal());
		FoldersText += (FoldersText.empty() ? "" : ", ") + EscapePath(Folder);
	}
}

std::string FIncludeResolver::NameOf(const fs::path& Location) const
{
	std::error_code Code;
	for (const fs::path& Folder : Folders)
	{
		const fs::path Relative = Location.lexically_relative(Folder);
		if (Relative.empty() || *Relative.begin() == "..") { continue; }
		// Two folders may hold the same relative path. Only the first one found may use it as its name.
		const auto Is = [&](const fs::path& Other) { return fs::is_regular_file(Other / Relative, Code); };
		const auto First = std::find_if(Folders.begin(), Folders.end(), Is);
		return First != Folders.end() && *First == Folder ? Relative.generic_string() : Location.generic_string();
	}
	return Location.generic_string();
}

bool FIncludeResolver::FindInFolders(const fs::path& Relative, FFound& Out)
{
	const auto Try = [&](const fs::path& Location) {
		Out.File = Files.Read(Location);
		Out.Location = Location;
		return Out.File != nullptr;
	};
	bool bFound = false;
	if (Relative.is_absolute()) { bFound = Try(Relative.lexically_normal()); }
	for (size_t I = 0; I < Folders.size() && !bFound; ++I) { bFound = Try((Folders[I] / Relative).lexically_normal()); }
	if (bFound) { Out.Name = NameOf(Out.Location); }
	return bFound;
}

bool FIncludeResolver::FindInclude(const FWalk& Walk, const FIncludeTree::FNode& From, const FIncludeLine& Line, FFound& Out)
{
	const FShaderHeader* Header = Line.bQuoted ? Walk.FindHeader(fs::path(From.Name).parent_path() / Line.Name) : nullptr;
	Header = Header ? Header : Walk.FindHeader(Line.Name);
	if (Header)
	{
		Out.Name = Header->Name;
		Out.File = MakeShaderFile(Header->Text);
		return true;
	}
	if (Line.bQuoted && !From.Location.empty())
	{
		const fs::path Beside = (From.Location.parent_path() / Line.Name).lexically_normal();
		Out.File = Files.Read(Beside);
		if (Out.File)
		{
			Out.Location = Beside;
			Out.Name = NameOf(Beside);
			return true;
		}
	}
	// Text in memory has no file, only a path where it would lie in a search folder.
	if (Line.bQuoted && From.Location.empty() && FindInFolders(fs::path(From.Name).parent_path() / Line.Name, Out)) { return true; }
	return FindInFolders(Line.Name, Out);
}

void FIncludeResolver::Visit(FWalk& Walk, int Index)
{
	constexpr size_t MaxDepth = 64;
	FIncludeTree& Tree = Walk.Tree;
	Walk.Stack.push_back(Index);
	const std::shared_ptr<const FShaderFile> File = Tree.Nodes[Index].File;
	for (const FIncludeLine& Line : File->Includes)
	{
		FFound Found;
		if (!FindInclude(Walk, Tree.Nodes[Index], Line, Found))
		{
			Tree.Nodes[Index].Targets.push_back(FIncludeTree::Missing);
			Tree.bMissing |= Line.bQuoted;
			continue;
		}
		const std::string Key = Found.Location.empty() ? "memory:" + Found.Name : Found.Location.string();
		const auto [It, bNew] = Walk.ByLocation.try_emplace(Key, static_cast<int>(Tree.Nodes.size()));
		const int Target = It->second;
		Tree.Nodes[Index].Targets.push_back(Target);
		const auto Above = std::find(Walk.Stack.begin(), Walk.Stack.end(), Target);
		if (Above != Walk.Stack.end())
		{
			std::string Chain;
			std::for_each(Above, Walk.Stack.end(), [&](int Node) { Chain += EscapePath(Tree.Nodes[Node].Name) + " -> "; });
			Tree.Error =
			    fmt::format("{}:{}: cyclic include: {}{}", EscapePath(Tree.Nodes[Index].Name), Line.Line, Chain, EscapePath(Found.Name));
			return;
		}
		if (Walk.Stack.size() >= MaxDepth)
		{
			Tree.Error =
			    fmt::format("{}:{}: includes are nested more than {} deep", EscapePath(Tree.Nodes[Index].Name), Line.Line, MaxDepth);
			return;
		}
		if (bNew)
		{
			Tree.Nodes.push_back({Found.Name, Found.Location, Found.File, {}});
			Visit(Walk, Target);
			if (!Tree.Error.empty()) { return; }
		}
	}
	Walk.Stack.pop_back();
}

FIncludeTree FIncludeResolver::Resolve(const FShaderSource& Source)
{
	const std::string& Path = Source.Path;
	FIncludeTree Tree;
	FWalk Walk{Tree, Source, Headers, {}, {}};
	if (!Source.Text.empty()) { Tree.Nodes.push_back({Path, {}, MakeShaderFile(Source.Text), {}}); }
	else
	{
		FFound Found;
		if (Path.empty() || !FindInFolders(Path, Found))
		{
			Tree.Error = fmt::format("{}:0: shader not found (searched {})", EscapePath(Path), FoldersText);
			return Tree;
		}
		Tree.Nodes.push_back({Found.Name, Found.Location, Found.File, {}});
		Walk.ByLocation[Found.Location.string()] = 0;
	}
	Visit(Walk, 0);
	return Tree;
}

} // namespace Lantern
