// Feeds the scene loader arbitrary bytes as a .gltf or .glb in memory. A scene that loads must keep its promises, and
// what comes next (poses, joints, bounds) must stand it. Text that goes on after a zero byte is taken for the two chunks
// of a GLB: mutations would hardly ever keep the lengths of a real one right.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "LanternHost/SceneLoader.h"
#include "Support/TextCheck.h"

namespace
{

void AppendU32(std::string& Out, size_t Value)
{
	const uint32_t Narrow = uint32_t(Value);
	Out.append(reinterpret_cast<const char*>(&Narrow), 4);
}

std::string MakeGlb(const std::string& Json, const std::string& Binary)
{
	std::string Glb = "glTF";
	AppendU32(Glb, 2);
	AppendU32(Glb, 12 + 8 + Json.size() + 8 + Binary.size());
	AppendU32(Glb, Json.size());
	Glb += "JSON" + Json;
	AppendU32(Glb, Binary.size());
	Glb += std::string("BIN\0", 4) + Binary;
	return Glb;
}

std::string Prepare(const char* Data, size_t Size)
{
	const void* Zero = Size > 0 && Data[0] == '{' ? std::memchr(Data, 0, Size) : nullptr;
	if (Zero == nullptr) { return std::string(Data, Size); }
	std::string Json(Data, static_cast<const char*>(Zero)), Binary(static_cast<const char*>(Zero) + 1, Data + Size);
	Json.resize((Json.size() + 3) / 4 * 4, ' ');
	Binary.resize((Binary.size() + 3) / 4 * 4, '\0');
	return MakeGlb(Json, Binary);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* Data, size_t Size)
{
	using namespace Lantern;
	FLoadOptions Options;
	// Low, so that the fuzzer finds faults rather than the memory's end.
	Options.MaxGeometryBytes = Options.MaxImageBytes = 16 << 20;
	Options.MaxImageSize = 512;
	Options.MaxNodes = 10000;
	const std::string Document = Prepare(reinterpret_cast<const char*>(Data), Size);
	const FLoadResult Result = LoadSceneFromMemory(Document.data(), Document.size(), "fuzz", Options);
	if (Result.Scene.has_value() == !Result.Error.empty())
	{
		std::fprintf(stderr, "neither a scene nor an error, or both\n");
		std::abort();
	}
	if (!IsCleanText(Result.Error))
	{
		std::fprintf(stderr, "the error cannot be shown\n");
		std::abort();
	}
	if (!Result.Scene) { return 0; }
	for (const std::string& Warning : Result.Scene->Warnings)
	{
		if (!IsCleanText(Warning))
		{
			std::fprintf(stderr, "a warning cannot be shown\n");
			std::abort();
		}
	}
	const std::string Broken = ValidateScene(*Result.Scene);
	if (!Broken.empty())
	{
		std::fprintf(stderr, "a promise is broken: %s\n", Broken.c_str());
		std::abort();
	}
	for (const double Time : {0.0, 0.3, 1e6})
	{
		const FScenePose Pose = EvaluatePose(*Result.Scene, Time);
		glm::dvec3 Min, Max;
		GetSceneBounds(*Result.Scene, Pose, Min, Max);
		for (size_t I = 0; I < Result.Scene->Nodes.size(); ++I) { EvaluateJoints(*Result.Scene, Pose, int32_t(I)); }
	}
	return 0;
}
