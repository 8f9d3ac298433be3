# The shards of a plan, for make -C PLAN -f shards.mk SHARDS=N (or -j): the file shard-K is there when shard K is done.
# Names are seen from within PLAN, so that blanks in its own do no harm.
SUNDER ?= sunder
export SUNDER

shards: $(foreach k,$(shell seq 1 $(SHARDS)),shard-$(k))

shard-%:
	"$$SUNDER" separate --shard $* . --threads 1

.PHONY: shards
