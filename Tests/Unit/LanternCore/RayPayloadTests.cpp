// Sizes of ray payloads, measured on the SPIR-V of the plugin's own shaders: payload words are registers that every
// hit and miss moves, so that a member too many costs all rays.
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "LanternCore/Shaders/ShaderCompiler.h"

using namespace Lantern;

namespace
{

namespace fs = std::filesystem;

constexpr uint32_t StorageRayPayload = 5338, StorageIncomingRayPayload = 5342; // SpvStorageClass…KHR

/// Just enough of SPIR-V to measure a variable: types of scalars, vectors, arrays and structures without padding.
class FSpirvTypes
{
public:
	explicit FSpirvTypes(const std::vector<uint32_t>& Words)
	{
		for (size_t At = 5; At < Words.size(); At += std::max(1u, Words[At] >> 16))
		{
			Read(Words[At] & 0xffffu, &Words[At], Words[At] >> 16);
		}
	}
	const std::multiset<uint32_t>& GetPayloads() const { return Payloads; } ///< bytes

private:
	void Read(uint32_t Code, const uint32_t* Word, uint32_t Count)
	{
		switch (Code)
		{
		case 20: Bytes[Word[1]] = 4; break;                                // OpTypeBool
		case 21:                                                           // OpTypeInt
		case 22: Bytes[Word[1]] = Word[2] / 8; break;                      // OpTypeFloat
		case 23:                                                           // OpTypeVector
		case 24: Bytes[Word[1]] = Bytes[Word[2]] * Word[3]; break;         // OpTypeMatrix
		case 28: Bytes[Word[1]] = Bytes[Word[2]] * Values[Word[3]]; break; // OpTypeArray
		case 30:                                                           // OpTypeStruct
			Bytes[Word[1]] = 0;
			for (uint32_t Member = 2; Member < Count; ++Member) { Bytes[Word[1]] += Bytes[Word[Member]]; }
			break;
		case 32: Bytes[Word[1]] = Bytes[Word[3]]; break; // OpTypePointer: of what it points to
		case 43: Values[Word[2]] = Word[3]; break;       // OpConstant
		case 59:                                         // OpVariable
			if (Word[3] == StorageRayPayload || Word[3] == StorageIncomingRayPayload) { Payloads.insert(Bytes[Word[1]]); }
			break;
		default: break;
		}
	}

	std::map<uint32_t, uint32_t> Bytes, Values; // by id
	std::multiset<uint32_t> Payloads;
};

const std::map<std::string, ERTShaderStage>& GetRayStages()
{
	static const std::map<std::string, ERTShaderStage> Stages = {{".rgen", ERTShaderStage::RayGen}, {".rmiss", ERTShaderStage::Miss},
	    {".rchit", ERTShaderStage::ClosestHit}, {".rahit", ERTShaderStage::AnyHit}};
	return Stages;
}

FShaderSource MakeSource(const std::string& Path, bool bTransmission = false)
{
	FShaderSource Source{Path, GetRayStages().at(fs::path(Path).extension().string()), {}, {}};
	for (const char* Index : {"SHADOW_RAY", "SHADOW_MISS"}) { Source.Defines.emplace_back(Index, "0"); }
	for (const char* Index : {"MATERIAL_RAY", "MATERIAL_MISS"}) { Source.Defines.emplace_back(Index, "1"); }
	for (const char* Fact :
	    {"HAS_SUN", "HAS_SKY", "HAS_LIGHTS", "HAS_AREA_LIGHTS", "HAS_EMISSIVE", "HAS_MASKED", "SUN_RAYS", "LOCAL_RAYS", "MANY_LIGHTS"})
	{
		Source.Defines.emplace_back(Fact, "1");
	}
	Source.Defines.emplace_back("RAY_TYPES", "2");
	if (bTransmission) { Source.Defines.emplace_back("HAS_TRANSMISSION", "1"); }
	return Source;
}

std::multiset<uint32_t> MeasurePayloads(const std::string& Path, bool bTransmission = false, bool bDiffuseTransmission = false)
{
	FShaderCompiler Compiler(FShaderCompilerDesc{{LANTERN_SOURCE_DIR "/Shaders"}, ""});
	FShaderBinary Binary;
	FShaderSource Source = MakeSource(Path, bTransmission);
	if (bDiffuseTransmission) { Source.Defines.emplace_back("HAS_DIFFUSE_TRANSMISSION", "1"); }
	const FRTStatus Status = Compiler.Compile(Source, Binary);
	EXPECT_TRUE(Status) << Path << ": " << Status.Message;
	return FSpirvTypes(Binary.Words).GetPayloads();
}

using FSizes = std::multiset<uint32_t>;

// RayPrograms.cpp states these sizes.
TEST(RayPayload, LightFromBehindTakesEightBytes)
{
	for (const char* const Path : {"Rays/Material.rmiss", "Rays/Material.rchit"})
	{
		EXPECT_EQ(MeasurePayloads(Path, false, true), FSizes{44}) << Path;
		EXPECT_EQ(MeasurePayloads(Path, true, true), FSizes{52}) << Path;
	}
}

TEST(RayPayload, ShadowRayIsFourBytes)
{
	EXPECT_EQ(MeasurePayloads("Rays/ShadowQueue.rgen"), FSizes{4});
	EXPECT_EQ(MeasurePayloads("Rays/Shadow.rmiss"), FSizes{4});
}

TEST(RayPayload, MaterialRayIsThirtySixBytes)
{
	EXPECT_EQ(MeasurePayloads("Rays/Material.rmiss"), FSizes{36});
	EXPECT_EQ(MeasurePayloads("Rays/Material.rchit"), FSizes{36});
}

/// In scenes that light shines through something of.
TEST(RayPayload, MaterialRayIsFortyFourBytesWithGlass)
{
	EXPECT_EQ(MeasurePayloads("Rays/Material.rmiss", true), FSizes{44});
	EXPECT_EQ(MeasurePayloads("Rays/Material.rchit", true), FSizes{44});
	EXPECT_EQ(MeasurePayloads("Reference/PathTrace.rgen", true), FSizes{44}) << "its shadows have tints, by material rays";
	EXPECT_EQ(MeasurePayloads("Rays/Shadow.rmiss", true), FSizes{4});
}

TEST(RayPayload, ReferenceTracesThoseTwo) { EXPECT_EQ(MeasurePayloads("Reference/PathTrace.rgen"), (FSizes{4, 36})); }

TEST(RayPayload, AlphaTestTouchesNone) { EXPECT_EQ(MeasurePayloads("Rays/AlphaTest.rahit"), FSizes{}); }

// Whatever a later pass adds.
TEST(RayPayload, NoShaderHasALargerOne)
{
	const fs::path Root = LANTERN_SOURCE_DIR "/Shaders";
	size_t Shaders = 0;
	for (const fs::directory_entry& Entry : fs::recursive_directory_iterator(Root))
	{
		if (GetRayStages().count(Entry.path().extension().string()) == 0) { continue; }
		++Shaders;
		const std::string Path = fs::relative(Entry.path(), Root).string();
		for (const uint32_t Bytes : MeasurePayloads(Path))
		{
			EXPECT_LE(Bytes, Path.starts_with("Transmission/") ? 44u : 36u) << Path;
			EXPECT_GT(Bytes, 0u) << Path << ": a type that this test does not know";
		}
	}
	EXPECT_GE(Shaders, 6u);
}

// The reader itself: a structure of known size, arrays included.
TEST(RayPayload, IsMeasured)
{
	FShaderCompiler Compiler(FShaderCompilerDesc{{LANTERN_SOURCE_DIR "/Shaders"}, ""});
	FShaderSource Source = MakeSource("Test.rmiss");
	Source.Text = "#version 460\n#extension GL_EXT_ray_tracing : require\n"
	              "struct FInner { vec3 A; uint B; };\nstruct FPayload { FInner Inner[2]; float C; };\n"
	              "layout(location = 0) rayPayloadInEXT FPayload Payload;\n"
	              "void main() { Payload.C = 1.0; }\n";
	FShaderBinary Binary;
	const FRTStatus Status = Compiler.Compile(Source, Binary);
	ASSERT_TRUE(Status) << Status.Message;
	EXPECT_EQ(FSpirvTypes(Binary.Words).GetPayloads(), FSizes{36});
}

} // namespace
