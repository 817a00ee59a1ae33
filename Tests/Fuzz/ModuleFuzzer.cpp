// Plays sequences of module calls on a mock (Tests/Unit/LanternModule/ModulePlay.h).
#include <cstdio>
#include <cstdlib>

#include "ModulePlay.h"

namespace
{

Lantern::IRTModule& GetModule()
{
	static Lantern::TRTRef<Lantern::IRTModule> Module;
	if (!Module)
	{
		Lantern::FRTModuleDesc Desc;
		Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
		Desc.CacheFolder = LANTERN_TEST_CACHE;
		Desc.LogCallback = [](void*, Lantern::ERTModuleLog, const char*) {};
		const bool bMade = LanternCreateModule(Lantern::ModuleVersion, Module.ReleaseAndGetAddress()) == 0;
		if (!bMade || !Module->Initialize(Desc)) { std::abort(); }
	}
	return *Module;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* Data, size_t Size)
{
	Lantern::FModulePlay Play(GetModule());
	std::string Problem = Play.Play({Data, Size});
	Problem += Play.Finish();
	if (!Problem.empty())
	{
		std::fprintf(stderr, "%s\n", Problem.c_str());
		std::abort();
	}
	return 0;
}
