#include "ContractShaders.h"

#include "Shaders/Call_rgen.h"
#include "Shaders/Colour_frag.h"
#include "Shaders/Disc_rint.h"
#include "Shaders/Double_rcall.h"
#include "Shaders/Hit_rchit.h"
#include "Shaders/Hole_rahit.h"
#include "Shaders/MissOne_rmiss.h"
#include "Shaders/MissTwo_rmiss.h"
#include "Shaders/Query_comp.h"
#include "Shaders/SampleLevels_comp.h"
#include "Shaders/Square_rcall.h"
#include "Shaders/StoreImage_comp.h"
#include "Shaders/Trace_rgen.h"
#include "Shaders/Triangle_vert.h"
#include "Shaders/WriteWords_comp.h"

namespace Lantern
{

FRTShaderCode GetContractShader(const char* Name)
{
#define LANTERN_CONTRACT_SHADER(Symbol, Stage, File)                                                                   \
	{                                                                                                                  \
		Contract_##Symbol, std::size(Contract_##Symbol), Stage, File                                                   \
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
	};
#undef LANTERN_CONTRACT_SHADER
	for (const FRTShaderCode& Shader : All)
	{
		if (std::strcmp(Shader.Name, Name) == 0)
		{
			return Shader;
		}
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

TRTRef<IRTPipeline> MakeRasterPipeline(IRTDevice& Device, ERTFormat Color, ERTFormat Depth, ERTCull Cull,
                                       bool bDepthWrite)
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

TRTRef<IRTPipeline> MakeRayPipeline(IRTDevice& Device)
{
	const FRTShaderCode Shaders[] = {
	    GetContractShader("Trace.rgen"),    GetContractShader("Call.rgen"),    GetContractShader("MissOne.rmiss"),
	    GetContractShader("MissTwo.rmiss"), GetContractShader("Hit.rchit"),    GetContractShader("Hole.rahit"),
	    GetContractShader("Disc.rint"),     GetContractShader("Double.rcall"), GetContractShader("Square.rcall"),
	};
	FRTShaderGroup Groups[9];
	Groups[GroupTrace].General = 0;
	Groups[GroupCall].General = 1;
	Groups[GroupMissOne].General = 2;
	Groups[GroupMissTwo].General = 3;
	Groups[GroupHit].Kind = Groups[GroupMasked].Kind = ERTGroupKind::Triangles;
	Groups[GroupDisc].Kind = ERTGroupKind::Procedural;
	Groups[GroupHit].ClosestHit = Groups[GroupMasked].ClosestHit = Groups[GroupDisc].ClosestHit = 4;
	Groups[GroupMasked].AnyHit = 5;
	Groups[GroupDisc].Intersection = 6;
	Groups[GroupDouble].General = 7;
	Groups[GroupSquare].General = 8;
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = Shaders;
	Desc.ShaderCount = static_cast<uint32_t>(std::size(Shaders));
	Desc.Groups = Groups;
	Desc.GroupCount = static_cast<uint32_t>(std::size(Groups));
	Desc.MaxPayloadBytes = 4;
	Desc.Name = "ContractRTPSO";
	TRTRef<IRTPipeline> Out;
	EXPECT_OK(Device.CreateRayTracingPipeline(Desc, Out.ReleaseAndGetAddress()));
	return Out;
}

} // namespace Lantern
