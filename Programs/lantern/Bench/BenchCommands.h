// lantern bench: its subcommands.
#pragma once

#include <memory>

namespace CLI
{
class App;
}

namespace Lantern
{

/// Options of all benchmarks; they live as long as the parsing.
class FBenchCommands
{
public:
	FBenchCommands();
	~FBenchCommands();
	/// Adds the command to the program. Status gets the exit status of the benchmark that was named.
	void AddTo(CLI::App& App, int& Status);

private:
	struct FOptions;
	std::unique_ptr<FOptions> Options;
};

} // namespace Lantern
