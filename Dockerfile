# rollbem in a container: docker build -t rollbem . && docker run --rm rollbem --mu 0.3 --creep 0.1
# Files: docker run --rm -v "$PWD:/work" rollbem case.ini --plot tractions.png
FROM debian:12-slim AS build
RUN apt-get update && apt-get install -y --no-install-recommends make ca-certificates
COPY . /rollbem
WORKDIR /rollbem
RUN scripts/packages --install && make MPI= -j"$(nproc)" && \
    make MPI= DESTDIR=/installed PREFIX=/usr/local install install-python

FROM debian:12-slim
RUN apt-get update && apt-get install -y --no-install-recommends libopenblas0-pthread liblapacke libgsl27 \
    libinih1 libjansson4 libhdf5-103-1 libfftw3-double3 libsuitesparseconfig5 libumfpack5 libcholmod3 \
    libspqr2 libnlopt0 libgomp1 gnuplot-nox python3-numpy python3-matplotlib && rm -rf /var/lib/apt/lists/*
COPY --from=build /installed /
ENV PYTHONPATH=/usr/local/lib/python3/dist-packages
RUN ldconfig && useradd --create-home user
USER user
WORKDIR /work
ENTRYPOINT ["rollbem"]
