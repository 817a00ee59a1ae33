#include "LanternScene/MaterialPrograms.h"

#include <cassert>

namespace Lantern
{

namespace
{
constexpr const char* MaterialHeader = "Materials/Material.glsl";
}

FMaterialPrograms::FMaterialPrograms() { Add({.Name = "Standard"}); }

uint32_t FMaterialPrograms::Add(FMaterialProgramDesc Desc)
{
	Entries.push_back({std::move(Desc), 0});
	return GetCount() - 1;
}

void FMaterialPrograms::Edit(uint32_t Program, FMaterialProgramDesc Desc)
{
	assert(Program < GetCount());
	FEntry& Entry = Entries[Program];
	if (Entry.Desc == Desc) { return; }
	Entry.Desc = std::move(Desc);
	++Entry.Revision;
	++Edits;
}

FShaderSource FMaterialPrograms::MakeSource(FShaderSource Shader, uint32_t Program) const
{
	assert(Program < GetCount());
	const FMaterialProgramDesc& Desc = Entries[Program].Desc;
	if (Program != StandardProgram) { Shader.Name = (Shader.Name.empty() ? Shader.Path : Shader.Name) + " (" + Desc.Name + ")"; }
	if (!Desc.Text.empty())
	{
		const std::string Name = Desc.Path.empty() ? "Materials/" + Desc.Name + ".glsl" : Desc.Path;
		Shader.Headers.push_back({MaterialHeader, Desc.Text, Name});
	}
	else if (!Desc.Path.empty())
	{
		Shader.Headers.push_back({MaterialHeader, "#include \"" + Desc.Path + "\"\n", MaterialHeader});
	}
	return Shader;
}

} // namespace Lantern
