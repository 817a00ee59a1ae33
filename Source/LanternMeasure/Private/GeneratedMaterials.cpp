// Generates material programs of realistic size, and compiles or traces them.
#include "LanternMeasure/GeneratedMaterials.h"

#include <bit>
#include <chrono>
#include <random>

#include <fmt/format.h>

#include "LanternMeasure/MaterialWall.h"

namespace Lantern
{

namespace
{
/// A constant that can be found again in SPIR-V, and exchanged: a float of this range, whose lowest bits are the index.
constexpr uint32_t MarkBits = 0x47c30000u;
constexpr uint32_t MarkMask = 0xffff0000u;
/// What takes its place: of the same size, and different each time.
constexpr uint32_t RenewedBits = 0x47000000u;
constexpr uint32_t RenewedCount = 0x00c00000u;

/// One layer of a material, as artists stack them: a pattern, how it is blended, what it changes.
std::string MakeLayer(std::mt19937_64& Random)
{
	const auto Below = [&](uint32_t Limit) { return static_cast<uint32_t>(Random() % Limit); };
	const auto Number = [&] { return fmt::format("{:.6f}", 0.05 + double(Below(1'000'000)) / 250'000.0); };
	const std::string UV = fmt::format("(I.UV{} * vec2({}, {}) + vec2({}, {}))", Below(2), Number(), Number(), Number(), Number());
	std::string Pattern;
	switch (Below(5))
	{
	case 0: Pattern = fmt::format("Noise({})", UV); break;
	case 1: Pattern = fmt::format("0.5 + 0.5 * sin(dot({}, vec2({}, {})))", UV, Number(), Number()); break;
	case 2: Pattern = fmt::format("smoothstep(0.2, 0.8, Noise({}) * Noise({} * {}))", UV, UV, Number()); break;
	case 3:
		Pattern = fmt::format("pow(1.0 - abs(dot(S.Normal, normalize(vec3({}, {}, {})))), {})", Number(), Number(), Number(), Number());
		break;
	default: Pattern = fmt::format("step({}, fract({}.x) * fract({}.y))", Number(), UV, UV); break;
	}
	std::string Layer = fmt::format("\t{{\n\t\tfloat W = clamp({}, 0.0, 1.0) * {} * 0.2;\n", Pattern, Number());
	Layer += fmt::format("\t\tS.BaseColor = mix(S.BaseColor, vec3({}, {}, {}) * 0.2, W);\n", Number(), Number(), Number());
	switch (Below(4))
	{
	case 0: Layer += fmt::format("\t\tS.Roughness = mix(S.Roughness, {} * 0.2, W);\n", Number()); break;
	case 1: Layer += fmt::format("\t\tS.Normal = normalize(S.Normal + W * vec3({}, {}, {}) * 0.1);\n", Number(), Number(), Number()); break;
	case 2: Layer += fmt::format("\t\tS.Metallic = clamp(S.Metallic + W * {}, 0.0, 1.0);\n", Number()); break;
	default:
		Layer += "\t\tif (HasTexture(M, TEXTURE_BASE_COLOR)) { S.BaseColor *= mix(vec3(1.0), MaterialTexture(M, I, "
		         "TEXTURE_BASE_COLOR).bgr, W); }\n";
		break;
	}
	return Layer + "\t}\n";
}
} // namespace

uint64_t MakeSalt()
{
	static std::random_device Device;
	return (uint64_t(Device()) << 32) | Device();
}

FMaterialProgramDesc MakeBenchProgram(uint32_t Index, uint64_t Salt)
{
	std::mt19937_64 Random(Salt ^ (uint64_t(Index) * 0x9e3779b97f4a7c15ull));
	FMaterialProgramDesc Desc;
	Desc.Name = fmt::format("Bench{}", Index);
	Desc.Text = "#include \"Materials/Standard.glsl\"\n"
	            "float Noise(vec2 P)\n{\n"
	            "\tvec2 C = floor(P), F = fract(P);\n"
	            "\tvec4 H = fract(sin(vec4(dot(C, vec2(127.1, 311.7))) + vec4(0.0, 127.1, 311.7, 438.8)) * 43758.5453);\n"
	            "\tvec2 U = F * F * (3.0 - 2.0 * F);\n"
	            "\treturn mix(mix(H.x, H.y, U.x), mix(H.z, H.w, U.x), U.y);\n}\n"
	            "FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)\n{\n"
	            "\tFMaterialSurface S = EvaluateStandard(M, I, Override);\n";
	Desc.Text +=
	    fmt::format("\tS.BaseColor *= 1.0 + 1.0e-9 * fract(I.UV0.x * {:.9g});\n", std::bit_cast<float>(MarkBits + (Index & ~MarkMask)));
	const uint32_t Layers = 6 + static_cast<uint32_t>(Random() % 8);
	for (uint32_t Layer = 0; Layer < Layers; ++Layer) { Desc.Text += MakeLayer(Random); }
	Desc.Text += "\treturn S;\n}\n";
	return Desc;
}

FShaderSource MakeBenchRayGen() { return MakeMaterialTrace({.Path = "Bench/Trace.rgen"}); }

FRTStatus CompileBenchShaders(FShaderCompiler& Compiler, uint32_t Count, uint32_t Threads, FBenchShaders& Out, double& OutMs)
{
	FShaderSource RayGen = MakeBenchRayGen();
	RayGen.Stage = ERTShaderStage::RayGen;
	RayGen.Defines = {{"RAY_TYPES", "2"}, {"MATERIAL_RAY", "1"}, {"MATERIAL_MISS", "1"}};
	if (FRTStatus S = Compiler.Compile(RayGen, Out.RayGen); !S) { return S; }
	for (const char* Path : {"Rays/Shadow.rmiss", "Rays/Material.rmiss"})
	{
		if (FRTStatus S = Compiler.Compile({Path, ERTShaderStage::Miss, {}, {}}, Out.Misses.emplace_back()); !S) { return S; }
	}
	FMaterialPrograms Programs;
	const uint64_t Salt = MakeSalt();
	std::vector<FShaderSource> Sources;
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		Sources.push_back(
		    Programs.MakeSource({"Rays/Material.rchit", ERTShaderStage::ClosestHit, {}, {}}, Programs.Add(MakeBenchProgram(Index, Salt))));
	}
	Out.Hits.resize(Count);
	std::vector<FRTStatus> Results(Count);
	const auto Start = std::chrono::steady_clock::now();
	RunOnThreads(Threads, Count, [&](uint32_t Index) { Results[Index] = Compiler.Compile(Sources[Index], Out.Hits[Index]); });
	OutMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - Start).count();
	for (const FRTStatus& Result : Results)
	{
		if (!Result) { return Result; }
	}
	return FRTStatus::Success();
}

bool RenewShaders(FBenchShaders& Shaders)
{
	static uint32_t Next = static_cast<uint32_t>(MakeSalt() % RenewedCount);
	constexpr size_t HeaderWords = 5;
	constexpr uint32_t OpConstant = 43;
	for (FShaderBinary& Hit : Shaders.Hits)
	{
		bool bFound = false;
		for (size_t Word = HeaderWords; Word < Hit.Words.size() && !bFound;)
		{
			const uint32_t Length = Hit.Words[Word] >> 16;
			if (Length == 0) { return false; }
			if ((Hit.Words[Word] & 0xffffu) == OpConstant && Length == 4)
			{
				const uint32_t Value = Hit.Words[Word + 3];
				bFound = (Value & MarkMask) == MarkBits || (Value >= RenewedBits && Value < RenewedBits + RenewedCount);
				if (bFound) { Hit.Words[Word + 3] = RenewedBits + Next++ % RenewedCount; }
			}
			Word += Length;
		}
		if (!bFound) { return false; }
	}
	return true;
}

} // namespace Lantern
