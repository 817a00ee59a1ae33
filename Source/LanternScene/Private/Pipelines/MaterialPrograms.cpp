// The list of material programs, and the source of a shader with one of them.
#include "LanternScene/Pipelines/MaterialPrograms.h"

#include <cassert>

#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
constexpr const char* MaterialHeader = "Materials/Material.glsl";

/// Messages, traces and shaders show the name, and an engine may give any text.
FMaterialProgramDesc WithShownName(FMaterialProgramDesc Desc)
{
	Desc.Name = EscapeText(Desc.Name, MaxQuotedBytes);
	return Desc;
}
} // namespace

FMaterialPrograms::FMaterialPrograms() { Add({.Name = StandardProgramName}); }

uint32_t FMaterialPrograms::Add(FMaterialProgramDesc Desc)
{
	Entries.push_back({std::make_shared<const FMaterialProgramDesc>(WithShownName(std::move(Desc))), 0});
	return GetCount() - 1;
}

uint32_t FMaterialPrograms::FindOrAdd(FMaterialProgramDesc Desc)
{
	Desc = WithShownName(std::move(Desc));
	for (uint32_t Program = 0; Program < GetCount(); ++Program)
	{
		if (Get(Program) == Desc) { return Program; }
	}
	return Add(std::move(Desc));
}

void FMaterialPrograms::Edit(uint32_t Program, FMaterialProgramDesc Desc)
{
	assert(Program < GetCount());
	Desc = WithShownName(std::move(Desc));
	FEntry& Entry = Entries[Program];
	if (*Entry.Desc == Desc) { return; }
	Entry.Desc = std::make_shared<const FMaterialProgramDesc>(std::move(Desc));
	++Entry.Revision;
	++Edits;
}

FShaderSource FMaterialPrograms::MakeSource(FShaderSource Shader, const FMaterialProgramDesc& Program)
{
	if (Program.Name != StandardProgramName)
	{
		Shader.Name = (Shader.Name.empty() ? Shader.Path : Shader.Name) + " (" + Program.Name + ")";
	}
	if (!Program.Text.empty())
	{
		const std::string Name = Program.Path.empty() ? "Materials/" + Program.Name + ".glsl" : Program.Path;
		Shader.Headers.push_back({MaterialHeader, Program.Text, Name});
	}
	else if (!Program.Path.empty()) { Shader.Headers.push_back({MaterialHeader, "#include \"" + Program.Path + "\"\n", MaterialHeader}); }
	return Shader;
}

} // namespace Lantern
