// The shaders of each shader group, as its description and its material program say.
#include "Pipelines/RTPSOUnits.h"

#include <algorithm>
#include <cassert>

namespace Lantern
{

namespace
{
void AddRayTypeDefines(FShaderSource& Source, const FRTPSODesc& Desc)
{
	Source.Defines.emplace_back("RAY_TYPES", std::to_string(Desc.RayTypes.size()));
	for (size_t Type = 0; Type < Desc.RayTypes.size(); ++Type)
	{
		Source.Defines.emplace_back(Desc.RayTypes[Type].Name + "_RAY", std::to_string(Type));
		Source.Defines.emplace_back(Desc.RayTypes[Type].Name + "_MISS", std::to_string(Type));
	}
}

FPipelineUnit MakeGeneralUnit(FShaderSource Source, ERTShaderStage Stage)
{
	Source.Stage = Stage;
	FPipelineUnit Unit;
	Unit.Key = MakeSourceKey(Source);
	Unit.Name = Source.Path;
	Unit.Shaders.push_back(std::move(Source));
	return Unit;
}

void AddShader(FPipelineUnit& Unit, FShaderSource Source, ERTShaderStage Stage)
{
	Source.Stage = Stage;
	Unit.Key += '+' + MakeSourceKey(Source);
	Unit.Shaders.push_back(std::move(Source));
}

bool IsShared(const FRayType& Type, ERTHitClass Class) { return Type.ClosestHit && Type.bSharedClosestHit && Class == ERTHitClass::Opaque; }
} // namespace

std::string MakeSourceKey(const FShaderSource& Source)
{
	std::string Key = std::to_string(static_cast<int>(Source.Stage)) + Source.Path;
	for (const auto& [Name, Value] : Source.Defines) { Key += '|' + Name + '=' + Value; }
	if (!Source.Text.empty()) { Key += '|' + std::to_string(std::hash<std::string>()(Source.Text)); }
	return Key;
}

FPipelineUnit MakeRayGenUnit(const FRTPSODesc& Desc, uint32_t Index)
{
	FShaderSource Source = Desc.RayGens[Index];
	AddRayTypeDefines(Source, Desc);
	return MakeGeneralUnit(std::move(Source), ERTShaderStage::RayGen);
}

FPipelineUnit MakeMissUnit(const FRTPSODesc& Desc, uint32_t RayType)
{
	return MakeGeneralUnit(Desc.RayTypes[RayType].Miss, ERTShaderStage::Miss);
}

FPipelineUnit MakeCallableUnit(const FRTPSODesc& Desc, uint32_t Index)
{
	return MakeGeneralUnit(Desc.Callables[Index], ERTShaderStage::Callable);
}

FPipelineUnit MakeEmptyCallableUnit()
{
	FShaderSource Source;
	Source.Path = "EmptyCallable";
	Source.Text = "#version 460\n#extension GL_EXT_ray_tracing : require\nvoid main() {}\n";
	return MakeGeneralUnit(std::move(Source), ERTShaderStage::Callable);
}

FPipelineUnit MakeHitUnit(const FRTPSODesc& Desc, uint32_t RayType, FHitProgram Program, const FMaterialPrograms& Programs)
{
	const FRayType& Type = Desc.RayTypes[RayType];
	if (Type.bStandardProgram && Program.Class != ERTHitClass::Procedural) { Program.Program = StandardProgram; }
	FPipelineUnit Unit;
	if (IsShared(Type, Program.Class))
	{
		Unit = MakeGeneralUnit(*Type.ClosestHit, ERTShaderStage::ClosestHit);
		Unit.Kind = ERTGroupKind::Triangles;
		return Unit;
	}
	Unit.Key = "hit " + std::to_string(Program.Program) + (Program.Class == ERTHitClass::Procedural ? " procedural:" : ":");
	constexpr const char* Classes[HitClassCount] = {" opaque", " masked", " procedural", " plainly masked"};
	Unit.Name = Programs.Get(Program.Program).Name + ' ' + Type.Name + Classes[static_cast<uint32_t>(Program.Class)];
	Unit.Version = Programs.GetRevision(Program.Program);
	Unit.Program = Programs.Share(Program.Program);
	Unit.Kind = Program.Class == ERTHitClass::Procedural ? ERTGroupKind::Procedural : ERTGroupKind::Triangles;
	if (Type.ClosestHit) { AddShader(Unit, *Type.ClosestHit, ERTShaderStage::ClosestHit); }
	if (IsMasked(Program.Class))
	{
		FShaderSource Source = Type.MaskedAnyHit;
		if (Program.Class == ERTHitClass::MaskedPlain) { Source.Defines.emplace_back("PLAIN_OPACITY", "1"); }
		AddShader(Unit, std::move(Source), ERTShaderStage::AnyHit);
	}
	if (Program.Class == ERTHitClass::Procedural)
	{
		FShaderSource Source;
		Source.Path = Programs.Get(Program.Program).IntersectionPath;
		if (Source.Path.empty()) { Source.Path = "Rays/NoIntersection.rint"; }
		AddShader(Unit, std::move(Source), ERTShaderStage::Intersection);
	}
	for (FShaderSource& Source : Unit.Shaders)
	{
		if (Unit.Kind == ERTGroupKind::Procedural) { Source.Defines.emplace_back("PROCEDURAL", "1"); }
	}
	return Unit;
}

FPipelineUnit MakeStandInUnit(const FRTPSODesc& Desc, uint32_t RayType, ERTHitClass Class, const FMaterialPrograms& Programs)
{
	FPipelineUnit Unit = MakeHitUnit(Desc, RayType, {StandardProgram, Class}, Programs);
	if (IsShared(Desc.RayTypes[RayType], Class)) { return Unit; }
	Unit.Key = "stand-in " + Unit.Key;
	Unit.Name = "StandIn" + Unit.Name.substr(Programs.Get(StandardProgram).Name.size());
	for (FShaderSource& Source : Unit.Shaders)
	{
		Source.Name = Source.Path + " (StandIn)";
		if (Source.Stage != ERTShaderStage::Intersection) { Source.Defines.emplace_back("STAND_IN", "1"); }
		if (Source.Stage == ERTShaderStage::Intersection) { Source.Path = "Rays/NoIntersection.rint"; }
	}
	return Unit;
}

uint32_t GetPayloadBytes(const FRTPSODesc& Desc)
{
	uint32_t Bytes = 4;
	for (const FRayType& Type : Desc.RayTypes) { Bytes = std::max(Bytes, Type.PayloadBytes); }
	return Bytes;
}

FRTShaderGroup MakeGroup(ERTGroupKind Kind, const std::vector<ERTShaderStage>& Stages, const std::vector<uint32_t>& Indices)
{
	assert(Indices.size() == Stages.size());
	FRTShaderGroup Group{Kind};
	for (size_t I = 0; I < Indices.size(); ++I)
	{
		switch (Stages[I])
		{
		case ERTShaderStage::ClosestHit: Group.ClosestHit = Indices[I]; break;
		case ERTShaderStage::AnyHit: Group.AnyHit = Indices[I]; break;
		case ERTShaderStage::Intersection: Group.Intersection = Indices[I]; break;
		default: Group.General = Indices[I]; break;
		}
	}
	return Group;
}

} // namespace Lantern
