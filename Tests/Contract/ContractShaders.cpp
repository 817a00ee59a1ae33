// Pipelines made of the shaders of the corpus.
#include "ContractShaders.h"

#include "Shaders/BoxHit_rchit.h"
#include "Shaders/Call_rgen.h"
#include "Shaders/Colour_frag.h"
#include "Shaders/Disc_rint.h"
#include "Shaders/Double_rcall.h"
#include "Shaders/HitCalls_rchit.h"
#include "Shaders/Hit_rchit.h"
#include "Shaders/Hole_rahit.h"
#include "Shaders/MissOne_rmiss.h"
#include "Shaders/MissTwo_rmiss.h"
#include "Shaders/Parity_rahit.h"
#include "Shaders/Query_comp.h"
#include "Shaders/SaltHit_rchit.h"
#include "Shaders/SaltMiss_rmiss.h"
#include "Shaders/Salt_rcall.h"
#include "Shaders/SampleLevels_comp.h"
#include "Shaders/Slab_rint.h"
#include "Shaders/Square_rcall.h"
#include "Shaders/StoreImage_comp.h"
#include "Shaders/Trace_rgen.h"
#include "Shaders/Triangle_vert.h"
#include "Shaders/WriteWords_comp.h"

namespace Lantern
{

FRTShaderCode GetContractShader(const char* Name)
{
#define LANTERN_CONTRACT_SHADER(Symbol, Stage, File)                                                                                       \
	{                                                                                                                                      \
		Contract_##Symbol, std::size(Contract_##Symbol), Stage, File                                                                       \
	}
	static const FRTShaderCode All[] = {
	    LANTERN_CONTRACT_SHADER(WriteWords_comp, ERTShaderStage::Compute, "WriteWords.comp"),
	    LANTERN_CONTRACT_SHADER(StoreImage_comp, ERTShaderStage::Compute, "StoreImage.comp"),
	    LANTERN_CONTRACT_SHADER(SampleLevels_comp, ERTShaderStage::Compute, "SampleLevels.comp"),
	    LANTERN_CONTRACT_SHADER(Query_comp, ERTShaderStage::Compute, "Query.comp"),
	    LANTERN_CONTRACT_SHADER(Triangle_vert, ERTShaderStage::Vertex, "Triangle.vert"),
	    LANTERN_CONTRACT_SHADER(Colour_frag, ERTShaderStage::Fragment, "Colour.frag"),
	    LANTERN_CONTRACT_SHADER(Trace_rgen, ERTShaderStage::RayGen, "Trace.rgen"),
	    LANTERN_CONTRACT_SHADER(Call_rgen, ERTShaderStage::RayGen, "Call.rgen"),
	    LANTERN_CONTRACT_SHADER(MissOne_rmiss, ERTShaderStage::Miss, "MissOne.rmiss"),
	    LANTERN_CONTRACT_SHADER(MissTwo_rmiss, ERTShaderStage::Miss, "MissTwo.rmiss"),
	    LANTERN_CONTRACT_SHADER(Hit_rchit, ERTShaderStage::ClosestHit, "Hit.rchit"),
	    LANTERN_CONTRACT_SHADER(Hole_rahit, ERTShaderStage::AnyHit, "Hole.rahit"),
	    LANTERN_CONTRACT_SHADER(Disc_rint, ERTShaderStage::Intersection, "Disc.rint"),
	    LANTERN_CONTRACT_SHADER(Double_rcall, ERTShaderStage::Callable, "Double.rcall"),
	    LANTERN_CONTRACT_SHADER(Square_rcall, ERTShaderStage::Callable, "Square.rcall"),
	    LANTERN_CONTRACT_SHADER(BoxHit_rchit, ERTShaderStage::ClosestHit, "BoxHit.rchit"),
	    LANTERN_CONTRACT_SHADER(HitCalls_rchit, ERTShaderStage::ClosestHit, "HitCalls.rchit"),
	    LANTERN_CONTRACT_SHADER(Parity_rahit, ERTShaderStage::AnyHit, "Parity.rahit"),
	    LANTERN_CONTRACT_SHADER(Salt_rcall, ERTShaderStage::Callable, "Salt.rcall"),
	    LANTERN_CONTRACT_SHADER(SaltHit_rchit, ERTShaderStage::ClosestHit, "SaltHit.rchit"),
	    LANTERN_CONTRACT_SHADER(SaltMiss_rmiss, ERTShaderStage::Miss, "SaltMiss.rmiss"),
	    LANTERN_CONTRACT_SHADER(Slab_rint, ERTShaderStage::Intersection, "Slab.rint"),
	};
#undef LANTERN_CONTRACT_SHADER
	for (const FRTShaderCode& Shader : All)
	{
		if (std::strcmp(Shader.Name, Name) == 0) { return Shader; }
	}
	ADD_FAILURE() << "no contract shader " << Name;
	return {};
}

TRTRef<IRTPipeline> MakeComputePipeline(IRTDevice& Device, const char* Shader)
{
	FRTComputePipelineDesc Desc;
	Desc.Shader = GetContractShader(Shader);
	Desc.Name = Shader;
	TRTRef<IRTPipeline> Out;
	EXPECT_OK(Device.CreateComputePipeline(Desc, Out.ReleaseAndGetAddress()));
	return Out;
}

TRTRef<IRTPipeline> MakeRasterPipeline(IRTDevice& Device, ERTFormat Color, ERTFormat Depth, ERTCull Cull, bool bDepthWrite)
{
	FRTRasterPipelineDesc Desc;
	Desc.Vertex = GetContractShader("Triangle.vert");
	if (Color != ERTFormat::Unknown)
	{
		Desc.Fragment = GetContractShader("Colour.frag");
		Desc.ColorFormats = &Color;
		Desc.ColorCount = 1;
	}
	Desc.DepthFormat = Depth;
	Desc.Cull = Cull;
	Desc.bDepthWrite = bDepthWrite;
	Desc.Name = "Raster";
	TRTRef<IRTPipeline> Out;
	EXPECT_OK(Device.CreateRasterPipeline(Desc, Out.ReleaseAndGetAddress()));
	return Out;
}

FRTStatus CreateRays(IRTDevice& Device, const std::vector<FRayGroup>& Groups, bool bLibrary, const std::vector<IRTPipeline*>& Libraries,
    const char* Name, TRTRef<IRTPipeline>& Out)
{
	std::vector<FRTShaderCode> Shaders;
	const auto Add = [&](const char* File) {
		if (!File) { return NoShader; }
		Shaders.push_back(GetContractShader(File));
		return static_cast<uint32_t>(Shaders.size() - 1);
	};
	std::vector<FRTShaderGroup> Native;
	for (const FRayGroup& Group : Groups)
	{
		const ERTGroupKind Hit = Group.Intersection ? ERTGroupKind::Procedural : ERTGroupKind::Triangles;
		FRTShaderGroup& Item = Native.emplace_back();
		Item.Kind = Group.General ? ERTGroupKind::General : Hit;
		Item.General = Add(Group.General);
		Item.ClosestHit = Add(Group.ClosestHit);
		Item.AnyHit = Add(Group.AnyHit);
		Item.Intersection = Add(Group.Intersection);
	}
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = Shaders.data();
	Desc.ShaderCount = static_cast<uint32_t>(Shaders.size());
	Desc.Groups = Native.data();
	Desc.GroupCount = static_cast<uint32_t>(Native.size());
	Desc.Libraries = Libraries.data();
	Desc.LibraryCount = static_cast<uint32_t>(Libraries.size());
	Desc.bLibrary = bLibrary;
	Desc.MaxPayloadBytes = 4;
	Desc.Name = Name;
	return Device.CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress());
}

TRTRef<IRTPipeline> MakeRays(
    IRTDevice& Device, const std::vector<FRayGroup>& Groups, bool bLibrary, const std::vector<IRTPipeline*>& Libraries, const char* Name)
{
	TRTRef<IRTPipeline> Out;
	EXPECT_OK(CreateRays(Device, Groups, bLibrary, Libraries, Name, Out));
	return Out;
}

TRTRef<IRTPipeline> MakeRayPipeline(IRTDevice& Device)
{
	std::vector<FRayGroup> Groups(9);
	Groups[GroupTrace].General = "Trace.rgen";
	Groups[GroupCall].General = "Call.rgen";
	Groups[GroupMissOne].General = "MissOne.rmiss";
	Groups[GroupMissTwo].General = "MissTwo.rmiss";
	Groups[GroupHit].ClosestHit = "Hit.rchit";
	Groups[GroupMasked] = {nullptr, "Hit.rchit", "Hole.rahit"};
	Groups[GroupDisc] = {nullptr, "Hit.rchit", nullptr, "Disc.rint"};
	Groups[GroupDouble].General = "Double.rcall";
	Groups[GroupSquare].General = "Square.rcall";
	return MakeRays(Device, Groups, false, {}, "ContractRTPSO");
}

} // namespace Lantern
